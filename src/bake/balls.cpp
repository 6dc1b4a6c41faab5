#include "bake/balls.h"

#include "geometry/margin.h"

namespace bdpt {

bool chord(const Vec3& origin, const Vec3& direction, const Ball& ball, double& begin, double& end) {
  double to[3], along = 0, apart = 0;
  for (int axis = 0; axis < 3; ++axis) {
    to[axis] = double(ball.center[axis]) - double(origin[axis]);
    along += to[axis] * double(direction[axis]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double d = to[axis] - along * double(direction[axis]);
    apart += d * d;
  }
  const double half = double(ball.radius) * double(ball.radius) - apart;
  if (!(half > 0)) return false;
  begin = std::max(0.0, along - std::sqrt(half)), end = along + std::sqrt(half);
  return end > begin;
}

BallTree::BallTree(std::vector<Ball> balls) : balls_(std::move(balls)) {
  if (!balls_.empty()) split(0, uint32_t(balls_.size()));
}

void BallTree::split(uint32_t first, uint32_t last) {
  const size_t index = nodes_.size();
  Node node{Vec3(3e38f), Vec3(-3e38f), first, last, 0};
  for (uint32_t i = first; i < last; ++i) {
    const Ball& b = balls_[i];
    const float reach = b.radius * (1 + 1e-5f) + margin_of(largest(b.center));  // for what the boxes' test rounds
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis] = std::min(node.low[axis], b.center[axis] - reach);
      node.high[axis] = std::max(node.high[axis], b.center[axis] + reach);
    }
  }
  nodes_.push_back(node);
  if (last - first <= kLeaf) return;
  const Vec3 size = node.high - node.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const uint32_t middle = first + (last - first) / 2;
  std::nth_element(balls_.begin() + first, balls_.begin() + middle, balls_.begin() + last,
                   [&](const Ball& a, const Ball& b) { return a.center[axis] < b.center[axis]; });
  split(first, middle);
  nodes_[index].right = uint32_t(nodes_.size());
  split(middle, last);
}

}  // namespace bdpt
