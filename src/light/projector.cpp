// A spot that throws a picture: onto a plane across its axis it is the square round the cone.
#include "light/axes.h"
#include "light/kinds.h"
#include "light/picture.h"
#include "light/point.h"
#include "light/spot.h"
#include "light/texel_table.h"

namespace bdpt {

namespace {

class Projector : public LightData {
 public:
  Projector(const Picture& picture, const LightDesc& desc)
      : picture_(picture), axes_(desc.direction, desc.up), cone_{desc.cos_outer, desc.cos_inner} {
    half_ = std::sqrt(std::max(0.0f, 1 - cone_.cos_outer * cone_.cos_outer)) / cone_.cos_outer;
    texel_ = Vec2(2 * half_ / float(picture_.width()), 2 * half_ / float(picture_.height()));
    const std::vector<float> means = picture_.means();
    table_ = TexelTable(picture_.width(), picture_.height(), [&](uint32_t x, uint32_t y) {
      return weight(x, y, double(means[size_t(y) * picture_.width() + x]));
    });
  }

  const TexelTable& table() const { return table_; }
  double total() const { return total_; }
  double brightest() const { return brightest_; }
  const LightAxes& axes() const { return axes_; }
  const SpotCone& cone() const { return cone_; }

  Rgb intensity(const Vec3& w) const {
    const Vec3 v = axes_.to_local(w);
    const float falloff = cone_.falloff(v.z / length(v));
    if (falloff == 0) return Rgb();
    const Vec2 p = place_of(v);
    return picture_.at(p.x, p.y) * falloff;
  }
  Vec3 sample(double rest, float u1, float u2) const {
    if (table_.empty()) return axes_.forward;  // black
    const TexelTable::Place t = table_.sample(rest, u1, u2);
    const float x = (float(t.x) + float(t.u)) * texel_.x - half_, y = half_ - (float(t.y) + float(t.v)) * texel_.y;
    return axes_.to_world(unit(Vec3(x, y, 1)));
  }
  float density(const Vec3& w) const {
    const Vec3 v = axes_.to_local(w);
    if (!(v.z > cone_.cos_outer)) return 0;
    const Vec2 p = place_of(v);
    const uint32_t x = std::min(uint32_t(std::max(p.x, 0.0f)), picture_.width() - 1),
                   y = std::min(uint32_t(std::max(p.y, 0.0f)), picture_.height() - 1);
    return table_.probability(x, y) / (texel_.x * texel_.y * v.z * v.z * v.z);  // from the plane to directions
  }

 private:
  // In texels.
  Vec2 place_of(const Vec3& v) const { return {(v.x / v.z + half_) / texel_.x, (half_ - v.y / v.z) / texel_.y}; }
  // What goes through a texel of that mean, at its most by the falloff.
  double weight(uint32_t x, uint32_t y, double mean) {
    const float left = float(x) * texel_.x - half_, top = half_ - float(y) * texel_.y;
    const auto nearest = [](float low, float high) { return low > 0 ? low : high < 0 ? -high : 0; };
    const float dx = nearest(left, left + texel_.x), dy = nearest(top - texel_.y, top);
    const float falloff = cone_.falloff(1 / std::sqrt(1 + dx * dx + dy * dy));
    const float cx = left + texel_.x / 2, cy = top - texel_.y / 2;
    const double cosine = 1 / std::sqrt(1 + double(cx) * cx + double(cy) * cy);
    const double area = double(texel_.x) * texel_.y * cosine * cosine * cosine;
    total_ += mean * area * double(cone_.falloff(float(cosine)));
    if (falloff > 0) brightest_ = std::max(brightest_, mean);
    return mean * area * double(falloff);
  }

  Picture picture_;
  LightAxes axes_;
  SpotCone cone_;
  float half_;  // of the square, at distance 1
  Vec2 texel_;  // its size there
  TexelTable table_;
  double total_ = 0, brightest_ = 0;
};

const Projector& projector_of(const Light& light) { return static_cast<const Projector&>(*light.data); }

double power(const Light& light) { return projector_of(light).total(); }

void start(const Light& light, const StartNumbers& u, LightStart& start) {
  start.y0.p = start.origin = light.center;
  start.direction = projector_of(light).sample(u.rest, u.v1, u.v2);
}

Rgb emitted(const Light& light, const LightPoint&, const Vec3& w) { return projector_of(light).intensity(w); }
float direction_density(const Light& light, const LightPoint&, const Vec3&, const Vec3& w) {
  return projector_of(light).density(w);
}

Emitter bounds(const Light& light, uint32_t) {
  const Projector& p = projector_of(light);
  Emitter e = bounds_of_point(light, 0);
  e.axis = p.axes().forward;
  e.cos_o = p.cone().cos_outer;
  e.cos_e = 1 - 1e-4;  // cosines are rounded
  e.intensity = p.brightest();
  return e;
}

}  // namespace

const LightKind kProjectorLight = kind_at_point(power, start, emitted, direction_density, bounds);

std::unique_ptr<LightData> make_projector(const LightDesc& desc, Light& light) {
  light.kind = LightKindId::Projector;
  light.center = desc.position;
  light.radiance = desc.intensity;
  return std::make_unique<Projector>(Picture(desc.texture, desc.intensity, false), desc);
}

}  // namespace bdpt
