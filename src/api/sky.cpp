#include "light/sky.h"

#include "api/check.h"
#include "api/desc.h"

#include <Imath/ImathVec.h>

#include <numbers>

using namespace bdpt;

namespace {

struct SkyPicture {
  uint32_t width, height;
  Vec3 to_sun;
  double turbidity;
  Rgb ground;
};

SkyPicture read_sky(const bdpt_sky_desc& desc) {
  const Subject subject("sky", nullptr);
  subject.check_range("width", desc.width, 1, kMaxImageSide);
  subject.check_range("height", desc.height, 1, kMaxImageSide);
  subject.check_finite("to_sun", desc.to_sun, 3);
  subject.check_not_negative("ground", desc.ground, 3);
  if (desc.turbidity != 0) subject.check_range("turbidity", desc.turbidity, 1.7, 10);
  const Imath::V3d to_sun(desc.to_sun[0], desc.to_sun[1], desc.to_sun[2]);
  if (!(to_sun.y >= 0) || to_sun.length() == 0)
    subject.refuse("to_sun", "is below the horizon or of length zero: give a direction with y of at least 0");
  return {desc.width, desc.height, Vec3(to_sun / to_sun.length()), desc.turbidity == 0 ? 3.0 : double(desc.turbidity),
          to_rgb(desc.ground)};
}

}  // namespace

bdpt_result bdpt_sky_fill(const bdpt_sky_desc* desc, float* pixels, uint64_t capacity) {
  return guard(__func__, [&] {
    const SkyPicture p = read_sky(read_struct(desc, "desc"));
    require(pixels, "pixels");
    const uint64_t floats = uint64_t(p.width) * p.height * 3;
    if (capacity < floats)
      fail(ErrorCode::InvalidArgument, "capacity is ", capacity, ": the picture takes ", floats, " floats");
    const Sky sky(p.to_sun, p.turbidity);
    for (uint32_t y = 0; y < p.height; ++y) {
      const double theta = std::numbers::pi * (y + 0.5) / p.height;
      for (uint32_t x = 0; x < p.width; ++x) {
        const double phi = 2 * std::numbers::pi * ((x + 0.5) / p.width - 0.5);
        const Vec3 w(float(std::sin(theta) * std::sin(phi)), float(std::cos(theta)),
                     float(-std::sin(theta) * std::cos(phi)));
        const Rgb c = w.y > 0 ? sky.radiance(w) : p.ground;
        float* pixel = pixels + (uint64_t(y) * p.width + x) * 3;
        pixel[0] = c.r, pixel[1] = c.g, pixel[2] = c.b;
      }
    }
  });
}
