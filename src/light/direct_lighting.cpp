#include "light/direct_lighting.h"

namespace bdpt {

namespace {
// What an environment takes beside a tree: nothing tells how much of it a point sees.
constexpr float kEnvironmentShare = 0.5f;
}  // namespace

DirectLighting::DirectLighting(const Lights& lights, LightSelection selection)
    : lights_(lights), selection_(selection) {
  if (selection != LightSelection::Tree) return;
  tree_ = LightTree(lights.emitters());
  const bool shines = lights.has_environment() && !is_black(lights.environment_radiance());
  environment_ = !shines ? 0 : tree_.empty() ? 1 : kEnvironmentShare;
}

DirectLighting::Place DirectLighting::choose(const Receiver& x, int turn, double u, float& chosen) const {
  if (selection_ == LightSelection::Tree) {
    if (u < double(environment_)) {
      chosen = environment_;
      return {lights_.environment(), 0};
    }
    const LightTree::Choice c = tree_.sample(x, (u - double(environment_)) / (1 - double(environment_)));
    chosen = (1 - environment_) * c.probability;
    return {int(c.light), c.triangle};
  }
  int light = turn;
  chosen = 1;
  if (selection_ != LightSelection::Each) {
    light = lights_.choose(u, {.uniform = selection_ == LightSelection::Uniform});
    chosen = lights_.choice(light, {.uniform = selection_ == LightSelection::Uniform});
  }
  return {light, lights_.choose_triangle(light, u)};
}

float DirectLighting::choice(const LightPoint& y0, const Receiver& x) const {
  switch (selection_) {
    case LightSelection::Power:
      return lights_.choice(y0.light, {});
    case LightSelection::Uniform:
      return lights_.choice(y0.light, {.uniform = true});
    case LightSelection::Each:
      return 1;
    case LightSelection::Tree:
      break;
  }
  if (y0.infinite) return environment_;
  return (1 - environment_) * tree_.probability(lights_.first_emitter(y0.light) + y0.primitive, x);
}

float DirectLighting::density(const LightPoint& y0, const Receiver& x, float chosen) const {
  if (selection_ == LightSelection::Tree && !y0.infinite && lights_.is_mesh(y0.light))
    return chosen > 0 ? lights_.direct_density_of_triangle(y0, chosen) : 0;
  return lights_.direct_density(y0, x.p, chosen);
}

float DirectLighting::density(const LightPoint& y0, const Receiver& x) const { return density(y0, x, choice(y0, x)); }

bool DirectLighting::sample(const Receiver& x, int turn, double u, float u1, float u2, DirectLight& direct) const {
  if (lights_.empty()) return false;
  float chosen;
  const Place place = choose(x, turn, u, chosen);
  if (!lights_.place_direct(place.light, place.triangle, x.p, u1, u2, direct)) return false;
  direct.density = density(direct.y0, x, chosen);
  return direct.density > 0;
}

}  // namespace bdpt
