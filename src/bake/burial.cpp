#include "bake/burial.h"

#include "geometry/margin.h"
#include "sampling/warp.h"

#include <limits>

namespace bdpt {

namespace {

// Van der Corput's numbers.
float radical_inverse(uint32_t i) {
  float v = 0, digit = 0.5f;
  for (; i > 0; i >>= 1, digit /= 2)
    if (i & 1) v += digit;
  return v;
}

}  // namespace

Burial::Burial(const Scene& scene, const BurialDesc& desc)
    : scene_(scene), most_(desc.tolerance * float(desc.rays)), all_backs_(desc.all_backs) {
  const float n = float(desc.rays);
  for (int i = 0; i < desc.rays; ++i)
    directions_.push_back(sample_cosine_hemisphere((float(i) + 0.5f) / n, radical_inverse(uint32_t(i)) + 0.5f / n));
}

Ray Burial::ray(const Place& place, size_t number) const {
  const Vec3 w = Frame(place.normal).to_world(directions_[number % directions_.size()]);
  return {off_surface(place.p, place.normal, place.margin, w), std::numeric_limits<float>::infinity(), w};
}

void Burial::trace(const std::vector<Ray>& rays, std::vector<uint8_t>& backs) const {
  std::vector<Hit> hits(rays.size());
  scene_.rays().intersect(rays.data(), hits.data(), rays.size());
  backs.resize(rays.size());
  for (size_t i = 0; i < rays.size(); ++i) {
    Surface surface;
    backs[i] = hits[i].instance != kMiss && scene_.surface(rays[i], hits[i], surface) &&
               dot(surface.ng, rays[i].direction) > 0 &&
               (surface.material->one_sided || (all_backs_ && !surface.material->transmits()));
  }
}

bool Burial::suspects(const std::vector<Place>& places) const {
  std::vector<Ray> rays;
  rays.reserve(places.size());
  for (size_t i = 0; i < places.size(); ++i) rays.push_back(ray(places[i], i));
  std::vector<uint8_t> backs;
  trace(rays, backs);
  return std::any_of(backs.begin(), backs.end(), [](uint8_t b) { return b != 0; });
}

std::vector<uint8_t> Burial::test(const std::vector<Place>& places) const {
  std::vector<Ray> rays;
  rays.reserve(places.size() * directions_.size());
  for (const Place& place : places)
    for (size_t i = 0; i < directions_.size(); ++i) rays.push_back(ray(place, i));
  std::vector<uint8_t> backs, buried;
  trace(rays, backs);
  for (size_t i = 0; i < places.size(); ++i) {
    size_t met = 0;
    for (size_t k = 0; k < directions_.size(); ++k) met += backs[i * directions_.size() + k];
    buried.push_back(float(met) > most_);
  }
  return buried;
}

}  // namespace bdpt
