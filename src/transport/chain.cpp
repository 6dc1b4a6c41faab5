#include "transport/chain.h"

#include <cmath>

namespace bdpt {

namespace {

// Kelemen's small step: either way, by a distance between these, its logarithm uniform; from 1 on to 0.
constexpr float kSmallest = 1.0f / 1024, kLargest = 1.0f / 64;
constexpr uint32_t kChoices = 0, kFirst = 1;  // groups of the chain's own numbers

float perturb(float x, float u) {
  static const float range = std::log(kLargest / kSmallest);
  const bool up = u < 0.5f;
  const float step = kLargest * std::exp(-range * (up ? 2 * u : 2 * u - 1));
  x += up ? step : -step;
  x -= std::floor(x);
  return std::min(x, 0x1.fffffep-1f);
}

// Side, vertex and purpose, close together: vertex 0 has Start and Direction, all others Scatter and Connect.
uint32_t coordinate(bool eye, uint32_t vertex, Purpose purpose) {
  return 4 * vertex + 2 * (uint32_t(purpose) & 1) + uint32_t(eye);
}

}  // namespace

void Chain::begin(const TechniqueMask& mask, const StreamPair& streams, Technique technique, uint64_t seed) {
  seed_ = seed;
  streams_ = streams;
  technique_ = technique;
  edges_ = technique.s + technique.t - 1;
  mutation_ = state_mutation_ = 0;
  techniques_ = 0;
  uint32_t rank = 0;
  for (uint32_t s = 0; s <= edges_ + 1; ++s)
    if (mask.allows(int(s), int(edges_ + 1 - s))) {
      if (s == technique.s) rank = techniques_;
      ++techniques_;
    }
  choices_ = independent4(Stream(seed_, 0), kChoices);
  place_ = std::min((float(rank) + choices_[1]) / float(techniques_), 0x1.fffffep-1f);
  const Numbers none{{}, ~0u};
  proposal_.assign(coordinate(true, edges_ + 2, Purpose::Start), none);
  state_.assign(proposal_.size(), none);
}

void Chain::propose(const TechniqueMask& mask, float large_step) {
  choices_ = independent4(Stream(seed_, ++mutation_), kChoices);
  large_ = choices_[0] < large_step;
  place_ = large_ ? choices_[1] : perturb(state_place_, choices_[1]);
  technique_ = choose(mask, place_);
}

Technique Chain::choose(const TechniqueMask& mask, float u) const {
  uint32_t rank = std::min(uint32_t(u * float(techniques_)), techniques_ - 1), s = 0;
  while (!mask.allows(int(s), int(edges_ + 1 - s)) || rank-- > 0) ++s;
  return {s, edges_ + 1 - s};
}

void Chain::accept() {
  std::swap(proposal_, state_);
  state_mutation_ = mutation_;
  state_place_ = place_;
}

Four Chain::draw(const Engine& engine, bool eye, uint32_t vertex, Purpose purpose) {
  if (mutation_ == 0) {
    const Four u = engine.draw(eye ? streams_.eye : streams_.light, vertex, purpose);
    proposal_[coordinate(eye, vertex, purpose)] = {u, 0};
    return u;
  }
  const uint32_t i = coordinate(eye, vertex, purpose);
  Four u = independent4(Stream(seed_, mutation_), kFirst + i);
  if (!large_ && state_[i].mutation == state_mutation_)
    for (int d = 0; d < 4; ++d) u.u[d] = perturb(state_[i].u[d], u[d]);
  proposal_[i] = {u, mutation_};
  return u;
}

}  // namespace bdpt
