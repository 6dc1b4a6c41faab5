// Pictures that lights at one point throw.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ies.h"
#include "image.h"
#include "transform.h"

namespace bdpt_tool {

struct ThrownPicture {
  Image image;           // a square, black round the picture
  float cone_angle = 0;  // of the cone within that square, through the picture's corners
};

// `fov` is the angle over the picture's shorter side, in degrees. Along the light's +z, its top towards +y, its right
// towards +x, which is on the left of who looks along +z.
ThrownPicture throw_picture(const Image& image, float fov, const Transform& to_world);

// A square picture by equal areas, whose pole is the light's +y. Of directions about that, counted from +x.
Luminaire luminaire_of(const Image& square, const Transform& to_world);

}  // namespace bdpt_tool
