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
  // After all pieces are filled.
  void finish();

  uint64_t subpaths() const { return subpaths_; }
  // Those that can be joined.
  uint64_t vertices() const { return entries_.size(); }
  struct Entry {
    const Vertex* vertex;
    const LightSubpaths* subpaths;  // its piece, for its links
  };
  // In the order of the pieces.
  Entry vertex(uint64_t rank) const;

 private:
  struct Place {
    uint32_t piece, index;
  };
  uint64_t subpaths_ = 0;
  std::vector<LightSubpaths> pieces_;
  std::vector<Place> entries_;
};

// What a few light subpaths of reserved numbers tell; they measure nothing.
struct LightPilot {
  double vertices = 0;  // mean number of vertices of a light subpath
  double joinable = 0;  // of these, those that a plan can join
  TransportStats stats;
};
LightPilot pilot_light(const Engine& engine);

}  // namespace bdpt
