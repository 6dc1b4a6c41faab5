// Transforms as the host gives them.
#pragma once

#include "api/check.h"

namespace bdpt {

// Twelve zeros are the identity. Throws unless finite and invertible.
Transform read_transform(const Subject& subject, const float m[12], const char* field = "transform");
bool is_zero(const float m[12]);

// The factor by which a transform scales, if it does so alike in all directions; else 0.
double uniform_scale(const Transform& transform);

// The transform with its linear part made orthonormal; uniform_scale() must not be 0. Reflections stay reflections.
Transform without_scale(const Transform& transform);

// Coordinates beyond this are lost to the ray queries, without notice.
inline constexpr double kMaxCoordinate = 1e18;

}  // namespace bdpt
