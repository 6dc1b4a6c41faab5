// Meshes of surfaces given by formulas.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "scenes/scenes.h"

namespace bdpt_experiments {

// Points for u and v in [0, 1]; the ends of u are the same, those of v where `closed`. Normals are the derivatives'
// cross product.
bdpt_tool::TriangleMesh surface(int columns, int rows, bool closed, const std::function<Point(float u, float v)>& at);

bdpt_tool::TriangleMesh torus(const Point& center, float radius, float tube);
// A sphere with a pattern of bumps.
bdpt_tool::TriangleMesh bumpy_ball(const Point& center, float radius);
// A tube along a trefoil knot.
bdpt_tool::TriangleMesh knot(const Point& center, float size, float tube);

}  // namespace bdpt_experiments
