// The picture of an environment, by latitude and longitude, and how its directions are sampled.
//
// The middle of the picture is -z, its top +y, and to the right comes +x: what a camera at rest sees, wrapped round.
#pragma once

#include "light/infinity.h"
#include "light/picture.h"
#include "light/texel_table.h"
#include "math/transform.h"

namespace bdpt {

class EnvironmentMap : public InfiniteLight {
 public:
  // to_world turns the picture (and may reflect it).
  EnvironmentMap(const Picture& picture, const Transform& to_world);

  Rgb radiance(const Vec3& w) const;
  // The integral over all directions of norm(), texel by texel.
  double total() const { return total_; }

  // By radiance, or for direct lighting by what it stands out with: MIS compensation, Karlik et al. (2019). See
  // TexelTable for the numbers.
  Vec3 sample(bool direct, double rest, float u, float v) const;
  // Per solid angle; above 0 wherever there is radiance.
  float density(bool direct, const Vec3& w) const;

 private:
  // In texels from the left and from the top.
  struct Place {
    float x, y;
  };
  Place place_of(const Vec3& w) const;

  Picture picture_;
  Transform to_world_;
  uint32_t width_, height_;
  TexelTable all_, direct_;
  std::vector<double> edges_;               // sin²(theta / 2) of the rows' edges
  std::vector<float> inverse_solid_angle_;  // of a texel in each row
  double total_ = 0;
};

}  // namespace bdpt
