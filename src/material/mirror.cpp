// Specular reflection of the same colour at every angle.
#include "material/kinds.h"

namespace bdpt {
namespace {

BsdfValue evaluate_mirror(const Material&, const Rgb&, const Vec3&, const Vec3&, TransportMode) { return {}; }

BsdfSample sample_mirror(const Material& material, const Rgb& reflectance, const Vec3& previous, TransportMode,
                         const float[3]) {
  if (previous.z == 0 || is_blind_side(material, previous)) return {};
  BsdfSample s;
  s.next = {-previous.x, -previous.y, previous.z};
  s.weight = reflectance;
  s.density = s.density_reverse = std::fabs(previous.z);
  s.specular = true;
  return s;
}

}  // namespace

const MaterialKind kMirrorKind{evaluate_mirror, sample_mirror, always, never, always};

}  // namespace bdpt
