// What the numbers of an RGB space mean: its primaries, its white, and the matrices that follow.
#pragma once

#include <ImathMatrix.h>

#include <array>

namespace bdpt {

// CIE 1931 xy of what is seen where one channel is 1, and where all are.
struct Primaries {
  std::array<float, 2> red, green, blue, white;
  friend bool operator==(const Primaries&, const Primaries&) = default;
};

// ITU-R BT.709-6 table 1; IEC 61966-2-1 has the same.
inline constexpr Primaries kRec709{{0.64f, 0.33f}, {0.30f, 0.60f}, {0.15f, 0.06f}, {0.3127f, 0.3290f}};
// ITU-R BT.2020-2 table 3.
inline constexpr Primaries kRec2020{{0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.3290f}};
// SMPTE RP 431-2 with the white of SMPTE EG 432-1.
inline constexpr Primaries kP3D65{{0.680f, 0.320f}, {0.265f, 0.690f}, {0.150f, 0.060f}, {0.3127f, 0.3290f}};
// SMPTE ST 2065-1 (AP0) and AMPAS S-2014-004 (AP1).
inline constexpr Primaries kAp0{{0.7347f, 0.2653f}, {0.0f, 1.0f}, {0.0001f, -0.0770f}, {0.32168f, 0.33767f}};
inline constexpr Primaries kAp1{{0.713f, 0.293f}, {0.165f, 0.830f}, {0.128f, 0.044f}, {0.32168f, 0.33767f}};

// A colour is a row: rgb * matrix.
using ColorMatrix = Imath::M33d;

// To CIE XYZ; white has Y = 1, and the second column is what each channel brings to luminance.
// Errors: InvalidArgument, where the primaries span no colours or white is none of their mixtures.
ColorMatrix to_xyz(const Primaries& primaries);

// From one space to the other; white stays white, by Bradford's adaptation. CIE XYZ (with the white 1/3, 1/3) are not
// adapted, but taken as seen at D65.
ColorMatrix conversion(const Primaries& from, const Primaries& to);

// The primaries and white of a space with this matrix to XYZ.
Primaries primaries_of(const ColorMatrix& to_xyz);

}  // namespace bdpt
