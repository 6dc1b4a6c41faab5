// A point that sends into each direction what was measured of a luminaire.
#include "light/photometry.h"

#include "light/axes.h"
#include "light/kinds.h"
#include "light/point.h"
#include "light/texel_table.h"

#include <numbers>

namespace bdpt {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Intensities are linear in both angles between those measured; directions are sampled evenly within the cells that
// the angles make.
class Photometric : public LightData {
 public:
  Photometric(const Photometry& measured, const Vec3& direction, const Vec3& up)
      : axes_(direction, up), vertical_(measured.vertical) {
    unfold(measured);
    for (float v : vertical_) heights_.push_back(0.5 * (1 - std::cos(double(v) * kDegree)));
    if (rows() == 0) return;
    table_ = TexelTable(uint32_t(horizontal_.size() - 1), uint32_t(rows()), [&](uint32_t x, uint32_t y) {
      const double mean = 0.25 * (double(value(x, y)) + value(x + 1, y) + value(x, y + 1) + value(x + 1, y + 1));
      total_ += mean * solid_angle(x, y);
      return mean * solid_angle(x, y);
    });
    for (float v : values_) brightest_ = std::max(brightest_, v);
  }

  double total() const { return total_; }
  float brightest() const { return brightest_; }

  float intensity(const Vec3& w) const {
    const Place p = place_of(w);
    if (p.row < 0) return 0;
    const uint32_t x = uint32_t(p.column), y = uint32_t(p.row);
    const float u = (p.horizontal - horizontal_[x]) / (horizontal_[x + 1] - horizontal_[x]);
    const float v = (p.vertical - vertical_[y]) / (vertical_[y + 1] - vertical_[y]);
    return (value(x, y) * (1 - u) + value(x + 1, y) * u) * (1 - v) +
           (value(x, y + 1) * (1 - u) + value(x + 1, y + 1) * u) * v;
  }
  Vec3 sample(double rest, float u1, float u2) const {
    if (table_.empty()) return axes_.forward;  // black
    const TexelTable::Place t = table_.sample(rest, u1, u2);
    const double h = heights_[t.y] + t.v * (heights_[t.y + 1] - heights_[t.y]);
    const double z = 1 - 2 * h, r = 2 * std::sqrt(std::max(0.0, h * (1 - h)));
    const double low = double(horizontal_[t.x]), high = double(horizontal_[t.x + 1]);
    const double angle = (low + t.u * (high - low)) * kDegree;
    return unit(axes_.to_world(Vec3(float(-r * std::sin(angle)), float(r * std::cos(angle)), float(z))));
  }
  float density(const Vec3& w) const {
    const Place p = place_of(w);
    if (p.row < 0) return 0;
    const uint32_t x = uint32_t(p.column), y = uint32_t(p.row);
    return table_.probability(x, y) / float(solid_angle(x, y));
  }

 private:
  struct Place {
    float horizontal, vertical;
    int column, row;  // -1: dark
  };
  // Counted from up, counterclockwise for who looks along the axis.
  Place place_of(const Vec3& w) const {
    const Vec3 v = axes_.to_local(w);
    Place p;
    p.vertical = float(std::atan2(std::sqrt(v.x * v.x + v.y * v.y), v.z) / float(kDegree));
    p.horizontal = float(std::atan2(-v.x, v.y) / float(kDegree));
    if (p.horizontal < 0) p.horizontal += 360;
    p.horizontal = std::clamp(p.horizontal, 0.0f, 360.0f);
    const auto cell = [](const std::vector<float>& angles, float angle) {
      const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
      return int(above - angles.begin()) - 1;
    };
    const bool dark = rows() == 0 || p.vertical < vertical_.front() || p.vertical > vertical_.back();
    p.row = dark ? -1 : cell(vertical_, p.vertical);
    p.column = dark ? -1 : cell(horizontal_, p.horizontal);
    return p;
  }
  // To all 360 degrees.
  void unfold(const Photometry& m) {
    const size_t n = m.vertical.size();
    const auto add = [&](float angle, size_t i) {
      horizontal_.push_back(angle);
      for (size_t k = 0; k < n; ++k) values_.push_back(m.intensities[i * n + k]);
    };
    for (size_t i = 0; i < m.horizontal.size(); ++i) add(m.horizontal[i], i);
    if (m.horizontal.size() == 1) return add(360, 0);
    for (float whole = m.horizontal.back(); whole < 360; whole *= 2) {  // mirrored at 90, then at 180
      const size_t count = horizontal_.size();
      for (size_t i = count - 1; i-- > 0;) {
        horizontal_.push_back(2 * whole - horizontal_[i]);
        for (size_t k = 0; k < n; ++k) values_.push_back(values_[i * n + k]);
      }
    }
  }
  size_t rows() const { return vertical_.empty() ? 0 : vertical_.size() - 1; }
  float value(uint32_t x, uint32_t y) const { return values_[size_t(x) * vertical_.size() + y]; }
  double solid_angle(uint32_t x, uint32_t y) const {
    return 2 * (heights_[y + 1] - heights_[y]) * double(horizontal_[x + 1] - horizontal_[x]) * kDegree;
  }

  LightAxes axes_;
  std::vector<float> vertical_, horizontal_, values_;
  std::vector<double> heights_;  // (1 - cos) / 2 of the vertical angles
  TexelTable table_;
  double total_ = 0;
  float brightest_ = 0;
};

const Photometric& photometric_of(const Light& light) { return static_cast<const Photometric&>(*light.data); }

double power(const Light& light) { return photometric_of(light).total() * double(norm(light.radiance)); }

void start(const Light& light, const StartNumbers& u, LightStart& start) {
  start.y0.p = start.origin = light.center;
  start.direction = photometric_of(light).sample(u.rest, u.v1, u.v2);
}

Rgb emitted(const Light& light, const LightPoint&, const Vec3& w) {
  return light.radiance * photometric_of(light).intensity(w);
}
float direction_density(const Light& light, const LightPoint&, const Vec3&, const Vec3& w) {
  return photometric_of(light).density(w);
}

Emitter bounds(const Light& light, uint32_t) {
  Emitter e = bounds_of_point(light, 0);
  e.intensity *= double(photometric_of(light).brightest());
  return e;
}

}  // namespace

const LightKind kPhotometricLight = kind_at_point(power, start, emitted, direction_density, bounds);

std::unique_ptr<LightData> make_photometric(const LightDesc& desc, Light& light) {
  light.kind = LightKindId::Photometric;
  light.center = desc.position;
  light.radiance = desc.intensity;
  return std::make_unique<Photometric>(*desc.photometry, desc.direction, desc.up);
}

}  // namespace bdpt
