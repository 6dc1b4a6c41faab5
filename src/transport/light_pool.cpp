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

void LightPool::finish() {
  entries_.clear();
  for (uint32_t piece = 0; piece < pieces(); ++piece) {
    const std::vector<Vertex>& vertices = pieces_[piece].vertices;
    for (uint32_t i = 0; i < vertices.size(); ++i)
      if (vertices[i].is_joinable()) entries_.push_back({piece, i});
  }
}

LightPool::Entry LightPool::vertex(uint64_t rank) const {
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
