// The picture of an environment, by latitude and longitude, and how its directions are sampled.
//
// The middle of the picture is -z, its top +y, and to the right comes +x: what a camera at rest sees, wrapped round.
#pragma once

#include "light/light.h"
#include "light/texel_table.h"
#include "math/transform.h"

#include <memory>

namespace bdpt {

class Texture;

class EnvironmentMap : public LightData {
 public:
  // Radiance is `scale` times the picture, bilinear between texels. to_world turns it (and may reflect it).
  EnvironmentMap(std::shared_ptr<const Texture> picture, const Rgb& scale, const Transform& to_world);

  Rgb radiance(const Vec3& w) const;
  // The integral over all directions of norm(), texel by texel.
  double total() const { return total_; }

  // By radiance, or for direct lighting by what it stands out with: MIS compensation, Karlik et al. (2019). u, v, rest
  // in [0,1); rest has digits for both.
  Vec3 sample(bool direct, double rest, float u, float v) const;
  // Per solid angle; above 0 wherever there is radiance.
  float density(bool direct, const Vec3& w) const;
  // What it takes for a picture of this size.
  static uint64_t memory_of(uint32_t width, uint32_t height) { return uint64_t(width) * height * 2 * sizeof(uint32_t); }

 private:
  // In texels from the left and from the top.
  struct Place {
    float x, y;
  };
  Place place_of(const Vec3& w) const;
  // Over the texel, norm() of its mean radiance; mean by mean of the bilinear function's.
  double mean(uint32_t x, uint32_t y) const;
  Rgb texel(int64_t x, int64_t y) const;

  std::shared_ptr<const Texture> picture_;
  Rgb scale_;
  Transform to_world_;
  uint32_t width_, height_;
  TexelTable all_, direct_;
  std::vector<double> edges_;               // sin²(theta / 2) of the rows' edges
  std::vector<float> inverse_solid_angle_;  // of a texel in each row
  double total_ = 0;
};

}  // namespace bdpt
