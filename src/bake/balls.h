// Balls in space, and which of them a ray crosses.
#pragma once

#include "math/vec.h"

#include <cstdint>
#include <vector>

namespace bdpt {

struct Ball {
  Vec3 center;
  float radius;
  uint32_t number;  // its owner's
};

// Where a ray (direction: unit) runs within a ball, from its origin on; false where it does not.
bool chord(const Vec3& origin, const Vec3& direction, const Ball& ball, double& begin, double& end);

// A tree of boxes: balls are split in halves, along the longest side.
class BallTree {
 public:
  BallTree() = default;
  explicit BallTree(std::vector<Ball> balls);

  bool empty() const { return balls_.empty(); }
  // Calls visit(ball, begin, end) for each ball that a ray crosses before tmax, in no order that matters.
  template <class Visit>
  void each(const Vec3& origin, const Vec3& direction, float tmax, Visit&& visit) const {
    if (balls_.empty()) return;
    const Vec3 inverse(1 / direction.x, 1 / direction.y, 1 / direction.z);
    uint32_t stack[kMostDepth], depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const uint32_t index = stack[--depth];
      const Node& node = nodes_[index];
      if (!node.meets(origin, inverse, tmax)) continue;
      if (node.right != 0) {
        stack[depth++] = node.right;
        stack[depth++] = index + 1;
        continue;
      }
      for (uint32_t i = node.first; i < node.last; ++i) {
        double begin, end;
        if (chord(origin, direction, balls_[i], begin, end) && begin < double(tmax)) visit(balls_[i], begin, end);
      }
    }
  }

 private:
  static constexpr uint32_t kMostDepth = 64, kLeaf = 4;
  struct Node {
    Vec3 low, high;
    uint32_t first, last;  // balls
    uint32_t right;        // the second half; the first one is the next node. 0 for a leaf
    bool meets(const Vec3& origin, const Vec3& inverse, float tmax) const {
      float begin = 0, end = tmax;
      for (int axis = 0; axis < 3; ++axis) {  // what is not a number, of a ray within a side, shuts nothing out
        const float a = (low[axis] - origin[axis]) * inverse[axis], b = (high[axis] - origin[axis]) * inverse[axis];
        begin = std::max(begin, std::min(a, b)), end = std::min(end, std::max(a, b));
      }
      return begin <= end;
    }
  };
  void split(uint32_t first, uint32_t last);

  std::vector<Ball> balls_;
  std::vector<Node> nodes_;
};

}  // namespace bdpt
