// A material of the host's. What it returns is held against what it promised; a breach is a value that is not finite,
// and so a contribution that is rejected and counted.
#include "material/host.h"

#include <limits>

#include "material/kinds.h"

namespace bdpt {
namespace {

constexpr float kNotFinite = std::numeric_limits<float>::quiet_NaN();
constexpr float kUnit = 1e-3f;  // how far a direction's squared length may be from 1

bool is_good(float v) { return v >= 0 && std::isfinite(v); }
bool is_good(const BsdfValue& v) {
  return is_good(v.f.r) && is_good(v.f.g) && is_good(v.f.b) && is_good(v.density) && is_good(v.density_reverse) &&
         (is_black(v.f) || (v.density > 0 && v.density_reverse > 0));
}

BsdfValue evaluate_host(const Material& material, const Rgb& reflectance, const Vec3& previous, const Vec3& next,
                        TransportMode) {
  if (previous.z == 0 || next.z == 0 || is_blind_side(material, previous)) return {};
  if (!material.thin_walled && previous.z * next.z < 0) return {};
  BsdfValue v;
  if (!material.host->evaluate(material, reflectance, previous, next, v) || !is_good(v)) return {Rgb(kNotFinite), 1, 1};
  return v;
}

BsdfSample sample_host(const Material& material, const Rgb& reflectance, const Vec3& previous, TransportMode mode,
                       const float u[3]) {
  if (previous.z == 0 || is_blind_side(material, previous)) return {};
  BsdfSample s;
  Vec3 next(0);
  const bool done = material.host->sample(material, reflectance, previous, u, next);
  if (done && next == Vec3(0)) return {};  // absorbed
  if (!done || !(std::fabs(length_squared(next) - 1) < kUnit)) {
    s.next = previous;
    s.weight = Rgb(kNotFinite);
    s.density = s.density_reverse = 1;
    return s;
  }
  s = sampled(unit(next), evaluate_host(material, reflectance, previous, unit(next), mode));
  return s;
}

bool is_thin(const Material& m) { return m.thin_walled; }

}  // namespace

const MaterialKind kHostKind{evaluate_host, sample_host, never, is_thin, never};

}  // namespace bdpt
