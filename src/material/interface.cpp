// The boundary of a medium and nothing else: all light passes straight through. Where media count rays pass it without
// a vertex (see Interiors); elsewhere it is like an index-matched dielectric.
#include "material/kinds.h"

namespace bdpt {
namespace {

BsdfValue evaluate_interface(const Material&, const Rgb&, const Vec3&, const Vec3&, TransportMode) { return {}; }

BsdfSample sample_interface(const Material&, const Rgb&, const Vec3& previous, TransportMode, const float[3]) {
  return pass_straight(previous);
}

}  // namespace

const MaterialKind kInterfaceKind{evaluate_interface, sample_interface, always, always, always};

}  // namespace bdpt
