#include "color/primaries.h"

#include <cmath>

#include "base/error.h"

namespace bdpt {
namespace {

using Imath::V3d;

// With X + Y + Z = 1; blue of CIE XYZ itself has no luminance, so not with Y = 1.
V3d xyz(const std::array<float, 2>& xy) { return {xy[0], xy[1], 1.0 - xy[0] - xy[1]}; }

V3d white_of(const Primaries& primaries) { return xyz(primaries.white) / double(primaries.white[1]); }

// Whether the channels are X, Y and Z themselves, to the digits that files have.
bool is_xyz(const Primaries& p) {
  const auto near = [](const std::array<float, 2>& xy, float x, float y) {
    return std::abs(xy[0] - x) < 1e-4f && std::abs(xy[1] - y) < 1e-4f;
  };
  return near(p.red, 1, 0) && near(p.green, 0, 1) && near(p.blue, 0, 0) && near(p.white, 1 / 3.0f, 1 / 3.0f);
}

// What the eye is adapted to. Equal X, Y and Z are no white that anybody looks at: files of XYZ are seen at D65.
V3d adapted_white(const Primaries& primaries) { return white_of(is_xyz(primaries) ? kRec709 : primaries); }

ColorMatrix rows(const V3d& a, const V3d& b, const V3d& c) { return {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z}; }

ColorMatrix diagonal(const V3d& v) { return {v.x, 0, 0, 0, v.y, 0, 0, 0, v.z}; }

// Lam (1985), "Metamerism and colour constancy": XYZ to the responses of cones, as rows times this.
const ColorMatrix kBradford{0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296};

ColorMatrix adaptation(const V3d& from_white, const V3d& to_white) {
  const V3d from = from_white * kBradford, to = to_white * kBradford;
  return kBradford * diagonal(to / from) * kBradford.inverse();
}

}  // namespace

ColorMatrix to_xyz(const Primaries& primaries) {
  const auto& [red, green, blue, white] = primaries;
  for (const auto* xy : {&red, &green, &blue, &white})
    if (!std::isfinite((*xy)[0]) || !std::isfinite((*xy)[1]))
      fail(ErrorCode::InvalidArgument, "chromaticities (", (*xy)[0], ", ", (*xy)[1], ") are not finite");
  if (!(white[1] > 0)) fail(ErrorCode::InvalidArgument, "the white (", white[0], ", ", white[1], ") has no luminance");
  const ColorMatrix directions = rows(xyz(red), xyz(green), xyz(blue));
  if (!(std::abs(directions.determinant()) > 1e-6))
    fail(ErrorCode::InvalidArgument, "the primaries (", red[0], ", ", red[1], "), (", green[0], ", ", green[1], "), (",
         blue[0], ", ", blue[1], ") lie on a line: no three channels of them make colours");
  const V3d amounts = white_of(primaries) * directions.inverse();
  if (!(amounts.x > 0) || !(amounts.y > 0) || !(amounts.z > 0))
    fail(ErrorCode::InvalidArgument, "the white (", white[0], ", ", white[1],
         ") lies outside of the triangle of the primaries");
  return diagonal(amounts) * directions;
}

ColorMatrix conversion(const Primaries& from, const Primaries& to) {
  if (from == to) return {};
  return to_xyz(from) * adaptation(adapted_white(from), adapted_white(to)) * to_xyz(to).inverse();
}

Primaries primaries_of(const ColorMatrix& to_xyz) {
  const auto xy = [](const V3d& v) {
    const double sum = v.x + v.y + v.z;
    return std::array{static_cast<float>(v.x / sum), static_cast<float>(v.y / sum)};
  };
  return {xy(V3d(1, 0, 0) * to_xyz), xy(V3d(0, 1, 0) * to_xyz), xy(V3d(0, 0, 1) * to_xyz), xy(V3d(1, 1, 1) * to_xyz)};
}

}  // namespace bdpt
