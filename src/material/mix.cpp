// Two materials, each with its part: f and densities are linear in both.
#include "material/kinds.h"

namespace bdpt {
namespace {

float weight(const Material& material, int part) { return part ? material.mix : 1 - material.mix; }

BsdfValue evaluate_part(const Material& material, int part, const Rgb& reflectance, const Vec3& previous,
                        const Vec3& next, TransportMode mode) {
  const Material& m = *material.parts[part];
  const float w = weight(material, part);
  if (w == 0) return {};
  const BsdfValue v = evaluate(m, m.reflectance * reflectance, previous, next, mode);
  return {v.f * w, v.density * w, v.density_reverse * w};
}

BsdfValue evaluate_mix(const Material& material, const Rgb& reflectance, const Vec3& previous, const Vec3& next,
                       TransportMode mode) {
  if (is_blind_side(material, previous) || is_blind_side(material, next)) return {};
  BsdfValue v = evaluate_part(material, 0, reflectance, previous, next, mode);
  const BsdfValue w = evaluate_part(material, 1, reflectance, previous, next, mode);
  v.f += w.f;
  v.density += w.density;
  v.density_reverse += w.density_reverse;
  return v;
}

BsdfSample sample_mix(const Material& material, const Rgb& reflectance, const Vec3& previous, TransportMode mode,
                      const float u[3]) {
  if (is_blind_side(material, previous)) return {};
  const int part = u[2] < material.mix;
  const float w = weight(material, part), first = part ? 0 : material.mix;
  const float rest[3] = {u[0], u[1], std::min((u[2] - first) / w, 0x1.fffffep-1f)};
  const Material& m = *material.parts[part];
  BsdfSample s = sample(m, m.reflectance * reflectance, previous, mode, rest);
  if (!(s.density > 0) || is_blind_side(material, s.next)) return {};
  const Rgb f_cos = s.weight * s.density;
  s.density *= w;
  s.density_reverse *= w;
  if (s.specular) return s;
  const BsdfValue other = evaluate_part(material, 1 - part, reflectance, previous, s.next, mode);
  s.density += other.density;
  s.density_reverse += other.density_reverse;
  s.weight = (f_cos * w + other.f * std::fabs(s.next.z)) * (1 / s.density);
  return s;
}

bool is_specular(const Material& m) { return m.parts[0]->is_specular() && m.parts[1]->is_specular(); }
bool has_specular(const Material& m) { return m.parts[0]->has_specular() || m.parts[1]->has_specular(); }
bool transmits(const Material& m) { return m.parts[0]->transmits() || m.parts[1]->transmits(); }

}  // namespace

const MaterialKind kMixKind{evaluate_mix, sample_mix, is_specular, transmits, has_specular};

}  // namespace bdpt
