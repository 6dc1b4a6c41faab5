#include "light/direct_lighting.h"

namespace bdpt {

namespace {
// What infinite lights take beside a tree: nothing tells how much of them a point sees.
constexpr float kInfiniteShare = 0.5f;
}  // namespace

DirectLighting::DirectLighting(const Lights& lights, LightSelection selection)
    : lights_(lights), selection_(selection) {
  if (selection != LightSelection::Tree) return;
  tree_ = LightTree(lights.emitters());
  std::vector<double> power;
  for (int light : lights.infinite()) power.push_back(double(lights.choice(light, {})));
  infinite_ = Discrete(power);
  infinite_share_ = infinite_.empty() ? 0 : tree_.empty() ? 1 : kInfiniteShare;
}

DirectLighting::Place DirectLighting::choose(const Receiver& x, int turn, double u, float& chosen) const {
  if (selection_ == LightSelection::Tree) return choose_by_tree(x, u, chosen);
  int light = turn;
  chosen = 1;
  if (selection_ != LightSelection::Each) {
    light = lights_.choose(u, {.uniform = selection_ == LightSelection::Uniform});
    chosen = lights_.choice(light, {.uniform = selection_ == LightSelection::Uniform});
  }
  const uint32_t triangle = lights_.choose_triangle(light, u);
  return {light, triangle, u};
}

DirectLighting::Place DirectLighting::choose_by_tree(const Receiver& x, double u, float& chosen) const {
  const double share = double(infinite_share_);
  if (u < share) {
    u /= share;
    const size_t i = infinite_.sample(u);
    chosen = infinite_share_ * infinite_.probability(i);
    return {lights_.infinite()[i], 0, u};
  }
  const LightTree::Choice c = tree_.sample(x, (u - share) / (1 - share));
  chosen = (1 - infinite_share_) * c.probability;
  return {int(c.light), c.triangle, c.rest};
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
  if (y0.infinite) {
    const std::vector<int>& infinite = lights_.infinite();
    const auto place = std::lower_bound(infinite.begin(), infinite.end(), y0.light);
    return infinite_share_ > 0 ? infinite_share_ * infinite_.probability(size_t(place - infinite.begin())) : 0;
  }
  return (1 - infinite_share_) * tree_.probability(lights_.first_emitter(y0.light) + y0.primitive, x);
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
  if (!lights_.place_direct(place.light, {place.rest, place.triangle, u1, u2}, x.p, direct)) return false;
  direct.density = density(direct.y0, x, chosen);
  return direct.density > 0;
}

}  // namespace bdpt
