// The light subpaths of a whole pass, for plans that join an eye subpath to any of them.
#pragma once

#include "transport/block.h"

namespace bdpt {

class LightPool {
 public:
  // Pieces in which the pool is filled, in parallel. Their size is part of the order of vertices.
  static constexpr uint32_t kPiece = 1024;  // subpaths

  // A pool for so many subpaths, of a pass of its own.
  void begin(uint64_t subpaths);
  uint32_t pieces() const { return uint32_t(pieces_.size()); }
  // Traces a piece. Pieces in parallel.
  void fill(Block& block, uint64_t pass, uint32_t piece);
  // After all pieces are filled. By importance: a vertex is chosen half by its throughput, the light that arrives
  // there, and half alike, so that none is seldom chosen that many eye vertices would see.
  void finish(PoolSelection selection = PoolSelection::Uniform);

  uint64_t subpaths() const { return subpaths_; }
  // Bytes for each vertex beside itself, at the most.
  static size_t bytes_of_choice(PoolSelection selection) { return selection == PoolSelection::Importance ? 20 : 0; }
  // Those that can be joined.
  uint64_t vertices() const { return entries_.size(); }
  struct Entry {
    const Vertex* vertex;
    const LightSubpaths* subpaths;  // its piece, for its links
  };
  // The vertex for a number in [0,1), in the order of the pieces, and one over its probability.
  Entry choose(double u, double& one_in) const;

 private:
  struct Place {
    uint32_t piece, index;
  };
  uint64_t subpaths_ = 0;
  std::vector<LightSubpaths> pieces_;
  std::vector<Place> entries_;
  Discrete by_importance_;  // over the entries; empty: each alike
};

// What a few light subpaths of reserved numbers tell; they measure nothing.
struct LightPilot {
  double vertices = 0;  // mean number of vertices of a light subpath
  double joinable = 0;  // of these, those that a plan can join
  TransportStats stats;
};
LightPilot pilot_light(const Engine& engine);

}  // namespace bdpt
