// The pictures of infinite lights.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "image.h"
#include "transform.h"

namespace bdpt_tool {

// The place of a direction on Clarberg's square, and the direction of a place: areas on both are in proportion.
// Source: Clarberg (2008), "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD".
std::array<double, 2> square_of(const Vec3& direction);
Vec3 direction_of(const std::array<double, 2>& square);

struct PlacedPicture {
  Image image;                       // equirectangular, as LightDescription has it
  std::array<float, 12> to_world{};  // a rotation
};

// `to_world` is the light's transform in the file; where it mirrors, the picture is mirrored instead.
PlacedPicture place_picture(const Image& image, const Transform& to_world);

}  // namespace bdpt_tool
