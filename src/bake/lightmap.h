// The light that arrives at surfaces, by texels of their second uv set (Veach 10.6's measurements, with the texel's
// part of the surface for the support of W_e):
//   E_j = (1 / A_j) INT over what texel j covers, INT over the hemisphere, L(x, w) dw_projected dA
// Eye subpaths start in the texel, uniform by area. Light subpaths that land there count, too (t = 0).
#pragma once

#include "bake/surface_sensor.h"
#include "bake/texel_map.h"

namespace bdpt {

class Lightmap final : public SurfaceSensor {
 public:
  Lightmap(std::shared_ptr<const Scene> scene, const LightmapDesc& desc, const std::vector<OutputDesc>& outputs,
           const std::shared_ptr<MemoryMeter>& meter);

  const TexelMap& texels() const { return texels_; }

  int width() const override { return texels_.width(); }
  int height() const override { return texels_.height(); }
  uint64_t hash() const override { return hash_; }
  int64_t number(int x, int y) const override { return texels_.number(x, y); }
  uint64_t count() const override { return texels_.report().texels; }
  void find(uint64_t number, int& x, int& y) const override { texels_.find(number, x, y); }
  uint64_t place(int x, int y) const override {
    return uint64_t(y + texels_.window().y0) * uint64_t(atlas_width_) + uint64_t(x + texels_.window().x0);
  }

  EyeStart start_at(int x, int y, const float u[5]) const override;
  bool land(const Landing& landing, SensorPoint& z0) const override;

 private:
  TexelMap texels_;
  int atlas_width_;
  uint64_t hash_;
};

}  // namespace bdpt
