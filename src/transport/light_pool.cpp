#include "transport/light_pool.h"

namespace bdpt {

void LightPool::begin(uint64_t subpaths) {
  subpaths_ = subpaths;
  pieces_.resize((subpaths + kPiece - 1) / kPiece);
  entries_.clear();
}

void LightPool::fill(Block& block, uint64_t pass, uint32_t piece) {
  const uint64_t first = uint64_t(piece) * kPiece;
  block.run_light(pass, first, uint32_t(std::min<uint64_t>(kPiece, subpaths_ - first)), pieces_[piece]);
}

void LightPool::finish(PoolSelection selection) {
  entries_.clear();
  by_importance_ = {};
  for (uint32_t piece = 0; piece < pieces(); ++piece) {
    const std::vector<Vertex>& vertices = pieces_[piece].vertices;
    for (uint32_t i = 0; i < vertices.size(); ++i)
      if (vertices[i].is_joinable()) entries_.push_back({piece, i});
  }
  if (selection == PoolSelection::Uniform || entries_.empty()) return;
  const auto throughput = [&](const Place& p) { return double(norm(pieces_[p.piece].vertices[p.index].throughput)); };
  double sum = 0;
  for (const Place& place : entries_) sum += throughput(place);
  const double mean = sum / double(entries_.size());
  if (!std::isfinite(mean)) return;
  std::vector<double> weights;
  weights.reserve(entries_.size());
  for (const Place& place : entries_) weights.push_back(0.5 * throughput(place) + 0.5 * mean);
  by_importance_ = Discrete(weights);
}

LightPool::Entry LightPool::choose(double u, double& one_in) const {
  uint64_t rank;
  if (by_importance_.empty()) {
    one_in = double(vertices());
    rank = std::min(uint64_t(u * one_in), vertices() - 1);
  } else {
    u = std::min(u, 0x1.fffffffffffffp-1);  // a stratum's end is rounded
    rank = by_importance_.sample(u);
    one_in = 1 / double(by_importance_.probability(rank));
  }
  const Place place = entries_[rank];
  const LightSubpaths& piece = pieces_[place.piece];
  return {&piece.vertices[place.index], &piece};
}

LightPilot pilot_light(const Engine& engine) {
  constexpr uint32_t kSubpaths = 8192, kPiece = LightPool::kPiece;
  LightPilot pilot;
  Block block(engine);
  LightSubpaths kept;
  for (uint32_t first = 0; first < kSubpaths; first += kPiece) {
    block.run_light(kPilotPass, first, kPiece, kept);
    pilot.vertices += double(kept.vertices.size()) / kSubpaths;
    for (const Vertex& v : kept.vertices) pilot.joinable += (v.is_joinable() ? 1.0 : 0.0) / kSubpaths;
  }
  pilot.stats = block.take_stats();
  return pilot;
}

}  // namespace bdpt
