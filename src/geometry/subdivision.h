// Catmull-Clark surfaces, cut into triangles of their limit, watertight: what faces share is evaluated once.
#pragma once

#include "base/memory.h"
#include "geometry/mesh.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace bdpt {

class RayDevice;

enum class SubdivisionBoundary : uint8_t { Smooth, PinCorners, Pin };

struct ControlCage {
  // Limits of Embree.
  static constexpr uint32_t kMostCorners = 15, kMostFaces = 60, kMostNeighbours = 120;

  std::vector<Vec3> positions;  // and two zeros more, which Embree reads
  std::vector<uint32_t> counts, indices;
  std::vector<Vec2> uv;                // empty = absent
  std::vector<uint32_t> uv_indices;    // as indices
  std::vector<uint32_t> crease_edges;  // pairs of positions
  std::vector<float> crease_weights;
  std::vector<uint32_t> corners;
  std::vector<float> corner_weights;
  SubdivisionBoundary boundary = SubdivisionBoundary::Smooth;

  uint32_t position_count() const { return uint32_t(positions.size() - 2); }
};

// The edges that faces share, by corners: corner c stands for its position and the edge to the next corner of its face.
struct CageEdges {
  static constexpr uint32_t kNone = ~0u;
  std::vector<uint32_t> first;     // corner of each face, and the count of all
  std::vector<uint32_t> face;      // of each corner
  std::vector<uint32_t> opposite;  // the corner whose edge is the same, the other way; kNone on a boundary
  std::vector<uint32_t> edge;      // its number
  uint32_t count = 0;

  uint32_t next(uint32_t c) const { return c + 1 < first[face[c] + 1] ? c + 1 : first[face[c]]; }
  uint32_t previous(uint32_t c) const { return c > first[face[c]] ? c - 1 : first[face[c] + 1] - 1; }
};

// What is wrong with a cage: that two faces go along an edge in the same direction, or that faces which share no edges
// meet at a position.
struct CageFault {
  enum class Kind { None, Edge, Position } kind = Kind::None;
  uint32_t position = 0, other = 0;  // of the edge
  uint32_t faces[2] = {};
};

CageFault find_edges(const ControlCage& cage, CageEdges& edges);

struct Diced {
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> uv;
  std::vector<Triangle> triangles;
};

// New positions for `count` places; what displaced holds first is positions.
using Displace =
    std::function<void(size_t count, const Vec3* positions, const Vec3* normals, const Vec2* uv, Vec3* displaced)>;

// How much memory the dicing takes; more than 32-bit counts hold where `fits` is false.
struct DiceSize {
  uint64_t points = 0, triangles = 0, bytes = 0;
  bool fits = true;
};
DiceSize size_of_dice(const ControlCage& cage, const CageEdges& edges, uint32_t level);

// level: segments of each edge; even unless all faces have four corners. displace may be empty.
Diced dice(const ControlCage& cage, const CageEdges& edges, uint32_t level, const RayDevice& device,
           const Displace& displace);

}  // namespace bdpt
