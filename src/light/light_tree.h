// A tree of emitters, to choose one by what it may send to a point: Conty Estevez and Kulla, Importance Sampling of
// Many Lights with Adaptive Tree Splitting (2018), without the splitting.
//
// From the root down a child is chosen by its importance: its intensity, over the squared distance, times the greatest
// cosines that its bounds allow at both ends. Importance is a function of the node and the receiver alone, so the
// probability of any emitter can be had again at any time, by the way that leads to it.
#pragma once

#include "math/vec.h"

#include <cstdint>
#include <vector>

namespace bdpt {

// A point that is lit. normal: of shading, unit; light counts by its cosine, whichever side it comes from. Zero where
// no cosine bounds it: the surface lets light through.
struct Receiver {
  Vec3 p;
  Vec3 normal;
};

// What sends light: a triangle of a mesh, or another light; and its bounds: where it is, and the directions it sends
// to: at most cos_e from any direction that is within cos_o of the axis.
struct Emitter {
  uint32_t light = 0, triangle = 0;  // as Lights number them
  Vec3 low, high;
  Vec3 axis{0, 0, 1};      // unit
  double cos_o = -1;       // -1: all directions
  double cos_e = 0;        // of a diffuse surface: 0
  double intensity = 0;    // the most it sends in any direction; 0: nothing, it is never chosen
  bool two_sided = false;  // sends the same toward -axis
};

class LightTree {
 public:
  LightTree() = default;
  explicit LightTree(const std::vector<Emitter>& emitters);

  // Without any emitter that sends light.
  bool empty() const { return nodes_.empty(); }
  struct Choice {
    uint32_t light, triangle;
    float probability;
    double rest;  // what is left of u
  };
  // Chooses an emitter for x.
  Choice sample(const Receiver& x, double u) const;
  // The probability with which sample() chooses it, to the bit.
  float probability(uint32_t emitter, const Receiver& x) const;
  size_t memory() const { return nodes_.capacity() * sizeof(Node) + ways_.capacity() * sizeof(uint64_t); }

  static constexpr int kWidth = 4;
  typedef float Four __attribute__((vector_size(4 * kWidth)));

 private:
  static constexpr uint64_t kNoWay = ~0ull;
  // Up to four children side by side. Positions and directions are bounded by spheres and cones.
  struct Node {
    Four center[3] = {}, radius = {};
    Four axis[3] = {}, cos_o = {}, sin_o = {}, cos_e = {};
    Four two_sided = {};             // 1 or 0
    Four intensity = {};             // 0: no child
    int32_t child[kWidth] = {};      // a node, or ~light of an emitter
    uint32_t triangle[kWidth] = {};  // of an emitter
  };
  class Build;

  // What part of u each child takes.
  Four shares(const Node& node, const Receiver& x) const;

  std::vector<Node> nodes_;
  std::vector<uint64_t> ways_;  // of each emitter: its children's numbers from the root down, two bits each
  float floor_ = 0;             // least squared distance
};

}  // namespace bdpt
