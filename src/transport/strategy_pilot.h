// What a few bidirectional samples tell of every strategy that a tile may have: its variance and its cost (Grittmann et
// al. 2022). One set of samples serves all: a path x that came by technique i of the pilot, with the balance heuristic,
// contributes c = f / sum_j n_j p_j. With the strategy A it would contribute c / W_A, where W_A is the part that A's
// techniques have in the balance heuristic's weights, and the second moment of A's estimate is
//   sum_i E[c^2 / W_A]   over all techniques i of the pilot,
// also of paths that A's own techniques would find once in a million. To this come the products of different
// contributions of one sample, which are as they are, and the mean's square goes off.
//
// Random numbers are reserved and measure nothing; costs are counted, not timed: every range of passes learns the same.
#pragma once

#include "transport/block.h"

#include <array>
#include <vector>

namespace bdpt {

// What a tile may do: light subpaths for each eye subpath, and who joins them to it.
enum class Join { Path, TwoWay, OneToOne, Matrix };
struct Candidate {
  Join join;
  int light_samples;
};
inline constexpr std::array<Candidate, 10> kCandidates{{{Join::Path, 0},
                                                        {Join::TwoWay, 1},
                                                        {Join::OneToOne, 1},
                                                        {Join::Matrix, 1},
                                                        {Join::TwoWay, 2},
                                                        {Join::OneToOne, 2},
                                                        {Join::Matrix, 2},
                                                        {Join::TwoWay, 4},
                                                        {Join::OneToOne, 4},
                                                        {Join::Matrix, 4}}};

struct TileMeasure {
  double pixels = 0;
  double mean = 0;                                    // of a pixel
  std::array<double, kCandidates.size()> variance{};  // of a pixel by one sample, and one pass of light subpaths
  std::array<double, kCandidates.size()> cost{};      // of a sample, without its light subpaths
};

class StrategyPilot {
 public:
  explicit StrategyPilot(const Engine& engine);
  // Rows of tiles, in parallel.
  uint32_t tasks() const { return uint32_t(tiles_.rows()); }
  TransportStats run(uint32_t row);
  // After all rows: the choice of the highest efficiency.
  StrategyMap choose() const;

 private:
  struct LightImage {
    std::vector<std::array<double, kCandidates.size()>> squares;
    std::vector<double> sums;
    double cost = 0, subpaths = 0;
  };
  void run_tile(Block& block, int column, int row, LightImage& light);
  std::vector<TileMeasure> measures(double& light_cost) const;
  bool covers_all(Join join) const;

  Engine engine_;
  const Engine& target_;
  Tiles tiles_;
  uint32_t passes_;
  std::vector<TileMeasure> measures_;  // of the eye image
  std::vector<LightImage> light_;      // by rows
};

}  // namespace bdpt
