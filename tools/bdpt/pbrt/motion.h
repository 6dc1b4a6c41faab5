// The transforms of a pbrt scene: one when TransformTimes begin, one when they end.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "transform.h"

namespace bdpt_tool {

using TimeRange = std::array<double, 2>;

struct MovingTransform {
  Transform start, end;

  bool moves() const { return !(start == end); }
  MovingTransform inverse() const { return {start.inverse(), end.inverse()}; }
  bool operator==(const MovingTransform&) const = default;
};

MovingTransform operator*(const MovingTransform& a, const MovingTransform& b);

// What a transform is while the shutter is open, `moving` being that over `times`, and at rest before and after: of a
// shape, whose points move on straight lines, and of a camera, which turns evenly.
MovingTransform shape_in_shutter(const MovingTransform& moving, const TimeRange& times, const TimeRange& shutter);
MovingTransform camera_in_shutter(const MovingTransform& moving, const TimeRange& times, const TimeRange& shutter);

// Whether it rests for a part of the time that the shutter is open.
bool rests_in_shutter(const TimeRange& times, const TimeRange& shutter);

// By how much of its size a thing gets smaller on the way, its points moving on straight lines; 0 = it does not turn.
double shrinkage(const MovingTransform& moving);

}  // namespace bdpt_tool
