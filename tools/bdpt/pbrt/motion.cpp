// SPDX-License-Identifier: Apache-2.0
#include "pbrt/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bdpt_tool {
namespace {

Transform straight(const Transform& a, const Transform& b, double t) {
  Transform result;
  for (int i = 0; i < 12; ++i) result.m[i / 4][i % 4] = (1 - t) * a.m[i / 4][i % 4] + t * b.m[i / 4][i % 4];
  return result;
}

// Of transforms that turn, move and scale alike: b turned back by a part of what it turns from a.
Transform turning(const Transform& a, const Transform& b, double t) {
  const Transform turn = b * a.inverse();
  const auto& m = turn.m;
  const Vec3 axis = {m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]};
  Transform result = straight(a, b, t);
  if (length(axis) == 0) return result;
  const double degrees = std::atan2(length(axis), m[0][0] + m[1][1] + m[2][2] - 1) * 180 / std::numbers::pi;
  const Transform turned = rotation(t * degrees, axis) * a;
  for (int i = 0; i < 3; ++i) std::copy_n(turned.m[i], 3, result.m[i]);
  return result;
}

using Between = Transform(const Transform&, const Transform&, double);

MovingTransform in_shutter(const MovingTransform& moving, const TimeRange& times, const TimeRange& shutter,
                           Between* between) {
  if (!moving.moves()) return moving;
  const auto at = [&](double time) {
    if (time <= times[0]) return moving.start;
    if (time >= times[1]) return moving.end;
    return between(moving.start, moving.end, (time - times[0]) / (times[1] - times[0]));
  };
  return {at(shutter[0]), at(shutter[1])};
}

}  // namespace

MovingTransform operator*(const MovingTransform& a, const MovingTransform& b) {
  return {a.start * b.start, a.end * b.end};
}

MovingTransform shape_in_shutter(const MovingTransform& moving, const TimeRange& times, const TimeRange& shutter) {
  return in_shutter(moving, times, shutter, straight);
}

MovingTransform camera_in_shutter(const MovingTransform& moving, const TimeRange& times, const TimeRange& shutter) {
  return in_shutter(moving, times, shutter, turning);
}

bool rests_in_shutter(const TimeRange& times, const TimeRange& shutter) {
  return shutter[0] < times[0] || shutter[1] > times[1];
}

// Turning by an angle shrinks both directions across its axis by the cosine of half of it.
double shrinkage(const MovingTransform& moving) {
  const double middle = straight(moving.start, moving.end, 0.5).determinant();
  const double square = moving.start.determinant() * moving.end.determinant();
  if (!(square > 0)) return 0;
  return std::max(0.0, 1 - std::sqrt(std::abs(middle) / std::sqrt(square)));
}

}  // namespace bdpt_tool
