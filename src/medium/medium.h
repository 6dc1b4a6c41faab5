// What fills space: homogeneous media with a phase function. Distances to scattering are sampled by exp(-sigma_t d) of
// a channel that is chosen at random, each alike; so the density of a distance is the mean over the channels.
#pragma once

#include "math/vec.h"
#include "sampling/warp.h"

#include <string>

namespace bdpt {

struct Medium {
  std::string label;
  Rgb sigma_a, sigma_s;  // per world unit
  float g = 0;           // of Henyey and Greenstein: the mean cosine between light's directions before and after

  Rgb sigma_t() const { return sigma_a + sigma_s; }
  bool scatters() const { return !is_black(sigma_s); }
  Rgb transmittance(float d) const {
    const Rgb t = sigma_t();
    return {std::exp(-t.r * d), std::exp(-t.g * d), std::exp(-t.b * d)};
  }
  // The chance that no scattering is sampled before d; a medium that only absorbs has none to sample.
  float reach(float d) const {
    if (!scatters()) return 1;
    const Rgb t = transmittance(d);
    return (t.r + t.g + t.b) / 3;
  }
  // The density of scattering at d, given that light comes so far: over reach(d).
  float rate(float d) const {
    if (!scatters()) return 0;
    const Rgb s = sigma_t();
    const float least = std::min({s.r, s.g, s.b});  // what all have in common cancels
    const Rgb t(std::exp((least - s.r) * d), std::exp((least - s.g) * d), std::exp((least - s.b) * d));
    return (s.r * t.r + s.g * t.g + s.b * t.b) / (t.r + t.g + t.b);
  }
  // From two uniform numbers; infinite where nothing scatters.
  float sample_distance(float u0, float u1) const {
    const Rgb s = sigma_t();
    const float sigma = u0 < 1 / 3.0f ? s.r : u0 < 2 / 3.0f ? s.g : s.b;
    return -std::log1p(-u1) / sigma;
  }

  // The phase function, per solid angle, and its own density; both directions point away from the vertex (unit). Narrow
  // lobes are known by the distance from their axis: a cosine near 1 has lost it.
  float phase(const Vec3& previous, const Vec3& next) const {
    const float a = std::fabs(g), rest = 1 - a;
    const Vec3 off_axis = g > 0 ? next + previous : next - previous;
    const float d = rest * rest + a * dot(off_axis, off_axis);  // 1 + g^2 + 2 g cos
    return 0.25f * kInvPi * rest * (1 + a) / (d * std::sqrt(d));
  }
  Vec3 sample_phase(const Vec3& previous, float u0, float u1) const {
    const float a = std::fabs(g), rest = 1 - a, u = g > 0 ? u0 : 1 - u0;
    const float base = rest + 2 * a * (1 - u);
    const float x = std::min(rest * u * (rest * (1 + a) / base + rest) / base, 2.0f);  // 1 - cos from the axis
    const float cosine = g > 0 ? x - 1 : 1 - x, sine = std::sqrt(x * (2 - x)), phi = kTwoPi * u1;
    return Frame(previous).to_world({sine * std::cos(phi), sine * std::sin(phi), cosine});
  }
};

// The way along an edge, through one medium after another: what is left of light, and with which density the edge's
// ends are found by a walk along it.
class Passage {
 public:
  // The next stretch; nullptr: empty space.
  void add(const Medium* medium, float d) {
    float rate = 0;
    if (medium) {
      transmittance_ *= medium->transmittance(d);
      reach_ *= medium->reach(d);
      rate = medium->rate(d);
    }
    if (stretches_++ == 0) first_ = rate;
    last_ = rate;
  }
  const Rgb& transmittance() const { return transmittance_; }
  // Of finding the far end, or from there the near one, along the way: in a medium per length, else its probability.
  float density_to(bool in_medium) const { return reach_ * (in_medium ? last_ : 1); }
  float density_back(bool in_medium) const { return reach_ * (in_medium ? first_ : 1); }
  uint32_t stretches() const { return stretches_; }

 private:
  Rgb transmittance_{1};
  float reach_ = 1, first_ = 0, last_ = 0;
  uint32_t stretches_ = 0;
};

}  // namespace bdpt
