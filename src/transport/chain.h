// Markov chains of paths in primary sample space (Kelemen et al. 2002), multiplexed: the technique is one more
// coordinate (Hachisuka et al. 2014). A chain keeps to the number of edges that it began with.
//
// A path's coordinates are the numbers that it draws, named by side, vertex and purpose as everywhere. Those that it
// does not draw are uniform, whatever the others: they are no part of the state, and are drawn anew when a proposal
// asks for them. Each number is a function of the chain's seed and the number of the mutation.
#pragma once

#include "transport/engine.h"

#include <vector>

namespace bdpt {

struct StreamPair {
  Stream eye, light;
};
struct Technique {
  uint32_t s, t;
};

class Chain {
 public:
  // The first proposal is the path that these streams and this technique make.
  void begin(const TechniqueMask& mask, const StreamPair& streams, Technique technique, uint64_t seed);
  // The next proposal: a large step, all anew, or a small one.
  void propose(const TechniqueMask& mask, float large_step);
  // The proposal becomes the state.
  void accept();

  Technique technique() const { return technique_; }
  bool proposes(uint32_t s, uint32_t t) const { return s == technique_.s && t == technique_.t; }
  // The proposal's numbers.
  Four draw(const Engine& engine, bool eye, uint32_t vertex, Purpose purpose);
  // Whether to accept a proposal of this probability.
  bool accepts(float probability) const { return choices_[2] < probability; }

 private:
  struct Numbers {
    Four u;
    uint32_t mutation;  // that drew them
  };
  Technique choose(const TechniqueMask& mask, float u) const;

  uint64_t seed_ = 0;
  StreamPair streams_;
  uint32_t edges_ = 0, techniques_ = 0;         // k, and how many (s,t) with s + t - 1 = k take part
  uint32_t mutation_ = 0, state_mutation_ = 0;  // of the proposal and of the state
  bool large_ = false;
  Four choices_;
  Technique technique_{};
  float place_ = 0, state_place_ = 0;  // the coordinate of the technique
  std::vector<Numbers> proposal_, state_;
};

}  // namespace bdpt
