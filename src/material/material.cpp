#include "material/material.h"

#include <iterator>

#include "material/kinds.h"

namespace bdpt {
namespace {

struct Kind {
  EvaluateFunction* evaluate;
  SampleFunction* sample;
};

// In the order of MaterialType.
constexpr Kind kKinds[] = {
    {evaluate_diffuse, sample_diffuse},
    {evaluate_mirror, sample_mirror},
    {evaluate_conductor, sample_conductor},
    {evaluate_dielectric, sample_dielectric},
};
static_assert(std::size(kKinds) == static_cast<size_t>(MaterialType::Dielectric) + 1);

const Kind& kind_of(const Material& material) { return kKinds[static_cast<int>(material.type)]; }

}  // namespace

BsdfValue evaluate(const Material& material, const Rgb& reflectance, const Vec3& previous, const Vec3& next,
                   TransportMode mode) {
  return kind_of(material).evaluate(material, reflectance, previous, next, mode);
}

BsdfSample sample(const Material& material, const Rgb& reflectance, const Vec3& previous, TransportMode mode,
                  const float u[3]) {
  return kind_of(material).sample(material, reflectance, previous, mode, u);
}

}  // namespace bdpt
