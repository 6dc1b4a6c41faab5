// What the tests of materials share: materials by name, directions, and integration over the sphere.
#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "material/host.h"
#include "statistics.h"

namespace bdpt::material_testing {

using statistics::Uniform;

inline constexpr TransportMode kModes[] = {TransportMode::Radiance, TransportMode::Importance};

struct Named {
  std::string name;
  Material material;
};

inline Material diffuse() { return {}; }

inline Material mirror() {
  Material m;
  m.type = MaterialType::Mirror;
  return m;
}

inline Material conductor(float alpha_u, float alpha_v) {
  Material m;
  m.type = MaterialType::Conductor;
  m.eta = Rgb(0.14f, 0.38f, 1.44f);  // gold, about
  m.k = Rgb(3.98f, 2.40f, 1.60f);
  m.alpha_u = alpha_u, m.alpha_v = alpha_v;
  return m;
}

// Reflects all light at every microfacet.
inline Material lossless_conductor(float alpha_u, float alpha_v) {
  Material m = conductor(alpha_u, alpha_v);
  m.eta = Rgb(0), m.k = Rgb(3);
  return m;
}

inline Material dielectric(float ior, float alpha_u, float alpha_v) {
  Material m;
  m.type = MaterialType::Dielectric;
  m.ior = ior;
  m.alpha_u = alpha_u, m.alpha_v = alpha_v;
  return m;
}

inline Material reflecting(Material m, float reflectance) {
  m.reflectance = Rgb(reflectance);
  return m;
}

inline Material one_sided(Material m) {
  m.one_sided = true;
  return m;
}

inline Material single_scattering(Material m) {
  m.single_scattering = true;
  return m;
}

inline Material rough_diffuse(float roughness) {
  Material m;
  m.type = MaterialType::RoughDiffuse;
  m.diffuse_roughness = roughness;
  return m;
}

inline Material diffuse_transmission(const Rgb& transmittance) {
  Material m;
  m.type = MaterialType::DiffuseTransmission;
  m.transmittance = transmittance;
  return m;
}

inline Material coated_diffuse(float ior, float alpha_u, float alpha_v, float diffuse_roughness = 0) {
  Material m = dielectric(ior, alpha_u, alpha_v);
  m.type = MaterialType::CoatedDiffuse;
  m.diffuse_roughness = diffuse_roughness;
  return m;
}

inline Material coated_conductor(float coat_ior, float coat_alpha, float alpha_u, float alpha_v) {
  Material m = conductor(alpha_u, alpha_v);
  m.type = MaterialType::CoatedConductor;
  m.coat_ior = coat_ior, m.coat_alpha = coat_alpha;
  return m;
}

inline Material brushed(double angle = 0) {
  Material m;
  m.type = MaterialType::Brushed;
  m.tangent_cos = float(std::cos(angle)), m.tangent_sin = float(std::sin(angle));
  return m;
}

template <class Change>
Material principled(float alpha, const Change& change) {
  Material m;
  m.type = MaterialType::Principled;
  m.alpha_u = m.alpha_v = alpha;
  change(m);
  return m;
}
inline Material principled(float alpha) {
  return principled(alpha, [](Material&) {});
}

// A thin film on what is else.
inline Material filmed(Material m, float nanometres, float part = 1, float ior = 1.6f) {
  m.film = part, m.film_ior = ior, m.film_thickness = nanometres;
  return m;
}

// The parts live as long as the tests.
inline Material mix(const Material& a, const Material& b, float weight) {
  static std::deque<Material> parts;
  Material m;
  m.type = MaterialType::Mix;
  m.reflectance = Rgb(1);
  m.mix = weight;
  parts.push_back(a), m.parts[0] = &parts.back();
  parts.push_back(b), m.parts[1] = &parts.back();
  return m;
}

// Phong's lobe round the mirror's direction with a diffuse rest: symmetric, and no more than arrives.
class Phong : public HostMaterial {
 public:
  bool evaluate(const Material&, const Rgb& reflectance, const Vec3& p, const Vec3& n, BsdfValue& v) const override {
    const float c = std::max(n.z * p.z - n.x * p.x - n.y * p.y, 0.0f), lobe = c * c * c * c * kInvPi * 2.5f;
    v.f = reflectance * (0.5f * kInvPi) + Rgb(0.3f * lobe);
    v.density = 0.5f * kInvPi * std::fabs(n.z) + 0.5f * lobe;
    v.density_reverse = 0.5f * kInvPi * std::fabs(p.z) + 0.5f * lobe;
    return true;
  }
  bool sample(const Material&, const Rgb&, const Vec3& p, const float u[3], Vec3& next) const override {
    if (u[2] < 0.5f) {
      const float r = std::sqrt(u[0]), phi = kTwoPi * u[1];
      next = Vec3(r * std::cos(phi), r * std::sin(phi), std::copysign(safe_sqrt(1 - u[0]), p.z));
      return true;
    }
    const float z = std::pow(1 - u[0], 0.2f), r = safe_sqrt(1 - z * z), phi = kTwoPi * u[1];
    const Frame frame(Vec3(-p.x, -p.y, p.z));
    next = frame.to_world(Vec3(r * std::cos(phi), r * std::sin(phi), z));
    if (next.z * p.z <= 0) next = Vec3(0);
    return true;
  }
};

inline Material host() {
  static const Phong phong;
  Material m;
  m.type = MaterialType::Host;
  m.host = &phong;
  return m;
}

// Those of which one part is a Dirac and another is not.
inline std::vector<Named> partly_specular_materials() {
  return {{"coated diffuse 1.5, smooth", coated_diffuse(1.5f, 0, 0)},
          {"coated diffuse 1.8, smooth, rough base", coated_diffuse(1.8f, 0, 0, 0.7f)},
          {"coated diffuse 1.5, smooth, one-sided", one_sided(coated_diffuse(1.5f, 0, 0))},
          {"coated conductor 1.5, smooth over 0.3", coated_conductor(1.5f, 0, 0.3f, 0.3f)},
          {"principled, smooth", principled(0)},
          {"principled, smooth glass and metal",
           principled(0, [](Material& m) { m.transmission = 0.6f, m.metalness = 0.2f; })},
          {"principled, smooth thin wall", principled(0,
                                                      [](Material& m) {
                                                        m.transmission = 0.6f, m.thin_walled = true,
                                                        m.diffuse_transmission = 0.5f;
                                                        m.transmittance = Rgb(0.5f, 0.2f, 0.9f);
                                                      })},
          {"principled 0.4 below a smooth coat", principled(0.4f, [](Material& m) { m.coat = 0.8f; })},
          {"principled, smooth below a film", filmed(principled(0, [](Material& m) { m.metalness = 0.3f; }), 300)},
          {"principled, smooth glass and paint below a film",
           filmed(principled(0, [](Material& m) { m.transmission = 0.6f; }), 500, 0.7f)},
          {"mix of mirror and diffuse", mix(reflecting(mirror(), 0.9f), reflecting(diffuse(), 0.4f), 0.3f)},
          {"mix of glass and rough metal", mix(dielectric(1.5f, 0, 0), conductor(0.3f, 0.3f), 0.6f)}};
}

// Those that scatter into more than single directions.
inline std::vector<Named> nonspecular_materials() {
  return {
      {"diffuse", diffuse()},
      {"diffuse, one-sided", one_sided(diffuse())},
      {"conductor 0.05", conductor(0.05f, 0.05f)},
      {"conductor 0.3", conductor(0.3f, 0.3f)},
      {"conductor 1", conductor(1, 1)},
      {"conductor 0.1 x 0.5", conductor(0.1f, 0.5f)},
      {"conductor 0.4 x 0.08, one-sided", one_sided(conductor(0.4f, 0.08f))},
      {"dielectric 1.5, 0.05", dielectric(1.5f, 0.05f, 0.05f)},
      {"dielectric 1.5, 0.4", dielectric(1.5f, 0.4f, 0.4f)},
      {"dielectric 1.33, 0.1 x 0.5", dielectric(1.33f, 0.1f, 0.5f)},
      {"dielectric 0.7, 0.3 x 0.15", dielectric(0.7f, 0.3f, 0.15f)},
      {"dielectric 2.4, 1", dielectric(2.4f, 1, 1)},
      {"conductor 0.6, single scattering", single_scattering(conductor(0.6f, 0.6f))},
      {"dielectric 1.5, 0.6, single scattering", single_scattering(dielectric(1.5f, 0.6f, 0.6f))},
      {"diffuse, rough 0", rough_diffuse(0)},
      {"diffuse, rough 0.5", rough_diffuse(0.5f)},
      {"diffuse, rough 1, one-sided", one_sided(rough_diffuse(1))},
      {"diffuse transmission", diffuse_transmission(Rgb(0.1f, 0.4f, 0.2f))},
      {"coated diffuse 1.5, 0.1", coated_diffuse(1.5f, 0.1f, 0.1f)},
      {"coated diffuse 1.5, 0.3 x 0.6, rough base", coated_diffuse(1.5f, 0.3f, 0.6f, 0.8f)},
      {"coated diffuse 2.4, 1, one-sided", one_sided(coated_diffuse(2.4f, 1, 1))},
      {"coated conductor 1.5, 0.2 over 0.3 x 0.1", coated_conductor(1.5f, 0.2f, 0.3f, 0.1f)},
      {"coated conductor 1.3, 1 over 0", coated_conductor(1.3f, 1, 0, 0)},
      {"principled 0.25", principled(0.25f)},
      {"principled 1, metal", principled(1, [](Material& m) { m.metalness = 1; })},
      {"principled 0.3, all opaque", principled(0.3f,
                                                [](Material& m) {
                                                  m.metalness = 0.4f, m.coat = 0.7f, m.coat_alpha = 0.1f,
                                                  m.sheen = Rgb(0.3f, 0.8f, 0.5f);
                                                  m.sheen_alpha = 0.4f, m.diffuse_roughness = 0.5f,
                                                  m.specular_color = Rgb(0.5f, 1, 0.2f), m.specular = 0.7f;
                                                })},
      {"principled 0.2, anisotropic and turned", principled(0.2f,
                                                            [](Material& m) {
                                                              m.metalness = 0.5f, m.anisotropy = 0.7f,
                                                              m.tangent_cos = 0.6f, m.tangent_sin = 0.8f;
                                                            })},
      {"principled 0.3, refracting below a coat",
       principled(0.3f,
                  [](Material& m) { m.transmission = 0.7f, m.metalness = 0.1f, m.coat = 0.5f, m.coat_alpha = 0.2f; })},
      {"principled 0.3, thin wall", principled(0.3f,
                                               [](Material& m) {
                                                 m.transmission = 0.5f, m.thin_walled = true,
                                                 m.diffuse_transmission = 0.6f;
                                                 m.transmittance = Rgb(0.5f, 0.2f, 0.9f);
                                               })},
      {"principled 0.5, leaf",
       principled(0.5f, [](Material& m) { m.diffuse_transmission = 0.4f, m.transmittance = Rgb(0.5f, 0.8f, 0.1f); })},
      {"principled 0.3, paint below a film", filmed(principled(0.3f), 250)},
      {"principled 0.2, metal below half a film and a coat",
       filmed(principled(0.2f, [](Material& m) { m.metalness = 0.8f, m.coat = 0.5f, m.coat_alpha = 0.1f; }), 420,
              0.5f)},
      {"principled 0.3, glass below a film", filmed(principled(0.3f, [](Material& m) { m.transmission = 1; }), 300)},
      {"principled 0.4, glass below half a film",
       filmed(principled(0.4f, [](Material& m) { m.transmission = 0.7f; }), 600, 0.5f, 1.3f)},
      {"principled 0.3, bubble",
       filmed(principled(0.3f, [](Material& m) { m.transmission = 1, m.thin_walled = true, m.ior = 1; }), 500, 1,
              1.33f)},
      {"mix", mix(reflecting(diffuse(), 0.8f), conductor(0.2f, 0.4f), 0.3f)},
      {"mix of glass and paint",
       mix(dielectric(1.5f, 0.3f, 0.3f), reflecting(coated_diffuse(1.5f, 0.2f, 0.2f), 0.6f), 0.5f)},
      {"host", host()},
      {"host, one-sided", one_sided(host())}};
}

inline std::vector<Named> specular_materials() {
  return {{"mirror", mirror()},
          {"mirror, one-sided", one_sided(mirror())},
          {"conductor", conductor(0, 0)},
          {"dielectric 1.5", dielectric(1.5f, 0, 0)},
          {"dielectric 0.7", dielectric(0.7f, 0, 0)},
          {"dielectric 1", dielectric(1, 0, 0)},
          {"dielectric 1, rough", dielectric(1, 0.3f, 0.3f)},
          {"coated conductor", coated_conductor(1.5f, 0, 0, 0)},
          {"principled metal", principled(0, [](Material& m) { m.metalness = 1; })},
          {"principled glass below a smooth coat", principled(0, [](Material& m) { m.transmission = 1, m.coat = 1; })},
          {"principled thin glass", principled(0, [](Material& m) { m.transmission = 1, m.thin_walled = true; })},
          {"principled metal below a film", filmed(principled(0, [](Material& m) { m.metalness = 1; }), 400)},
          {"principled glass below a film", filmed(principled(0, [](Material& m) { m.transmission = 1; }), 400)},
          {"bubble", filmed(principled(0, [](Material& m) { m.transmission = 1, m.thin_walled = true, m.ior = 1; }),
                            500, 1, 1.33f)},
          {"mix of mirror and glass", mix(reflecting(mirror(), 0.9f), dielectric(1.5f, 0, 0), 0.5f)},
          {"brushed", brushed()},
          {"brushed, turned, one-sided", one_sided(brushed(0.7))}};
}

inline Vec3 direction(double theta, double phi) {
  return Vec3(static_cast<float>(std::sin(theta) * std::cos(phi)), static_cast<float>(std::sin(theta) * std::sin(phi)),
              static_cast<float>(std::cos(theta)));
}

inline Vec3 random_direction(Uniform& uniform) {
  const double z = 2.0 * uniform() - 1, phi = 2 * M_PI * uniform();
  return direction(std::acos(z), phi);
}

inline BsdfSample sample(const Material& m, const Rgb& reflectance, const Vec3& previous, TransportMode mode,
                         Uniform& uniform) {
  const float u[3] = {uniform(), uniform(), uniform()};
  return bdpt::sample(m, reflectance, previous, mode, u);
}

inline bool was_absorbed(const BsdfSample& s) { return s.density == 0; }

// The sphere cut into cells by s and phi round an axis, with cos = 1 - 2 s^power: equal areas for power 1, cells that
// narrow towards the axis for more.
class SphereGrid {
 public:
  SphereGrid(int rows, int columns, const Vec3& axis = Vec3(0, 0, 1), int power = 1)
      : rows_(rows), columns_(columns), power_(power), frame_(axis) {}

  size_t size() const { return static_cast<size_t>(rows_) * columns_; }

  size_t cell_of(const Vec3& v) const {
    const Vec3 w = frame_.to_local(v);
    const double r2 = double(w.x) * w.x + double(w.y) * w.y;
    const double t = 0.5 * (w.z > 0.5f ? r2 / (1.0 + w.z) : 1.0 - w.z);  // 1 - cos without cancellation
    const double phi = std::atan2(double(w.y), double(w.x)) / (2 * M_PI);
    const int row = static_cast<int>(std::pow(t, 1.0 / power_) * rows_);
    const int column = static_cast<int>((phi - std::floor(phi)) * columns_);
    return static_cast<size_t>(std::clamp(row, 0, rows_ - 1)) * columns_ + std::clamp(column, 0, columns_ - 1);
  }

  // The integral of a function of direction over every cell, by adaptive Gauss-Legendre quadrature.
  template <class Function>
  std::vector<double> integrate(const Function& function, double tolerance = 1e-7) const {
    std::vector<double> cells;
    cells.reserve(size());
    for (int i = 0; i < rows_; ++i)
      for (int j = 0; j < columns_; ++j) {
        const Rectangle r{double(i) / rows_, double(j) / columns_, 1.0 / rows_, 1.0 / columns_};
        cells.push_back(refine(function, r, gauss(function, r), tolerance, 9));
      }
    return cells;
  }

 private:
  struct Rectangle {
    double s, phi, ds, dphi;
  };

  template <class Function>
  double gauss(const Function& function, const Rectangle& r) const {
    static constexpr double kNodes[] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
    static constexpr double kWeights[] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                          0.1739274225687269};
    double sines[4], cosines[4], sum = 0;
    for (int j = 0; j < 4; ++j) {
      const double phi = 2 * M_PI * (r.phi + r.dphi * kNodes[j]);
      sines[j] = std::sin(phi), cosines[j] = std::cos(phi);
    }
    for (int i = 0; i < 4; ++i) {
      const double s = r.s + r.ds * kNodes[i];
      double s_power = 1;
      for (int k = 1; k < power_; ++k) s_power *= s;
      const double t = s_power * s, sin_theta = 2 * std::sqrt(t * (1 - t));
      for (int j = 0; j < 4; ++j) {
        const Vec3 w(static_cast<float>(sin_theta * cosines[j]), static_cast<float>(sin_theta * sines[j]),
                     static_cast<float>(1 - 2 * t));
        sum += kWeights[i] * kWeights[j] * 2 * power_ * s_power * function(unit(frame_.to_world(w)));
      }
    }
    return sum * r.ds * r.dphi * 2 * M_PI;
  }

  template <class Function>
  double refine(const Function& function, const Rectangle& r, double coarse, double tolerance, int depth) const {
    std::array<Rectangle, 4> parts;
    std::array<double, 4> values;
    double fine = 0;
    for (int k = 0; k < 4; ++k) {
      parts[k] = {r.s + (k & 1) * r.ds / 2, r.phi + (k >> 1) * r.dphi / 2, r.ds / 2, r.dphi / 2};
      fine += values[k] = gauss(function, parts[k]);
    }
    if (depth == 0 || std::fabs(fine - coarse) < tolerance) return fine;
    double sum = 0;
    for (int k = 0; k < 4; ++k) sum += refine(function, parts[k], values[k], tolerance / 2, depth - 1);
    return sum;
  }

  int rows_, columns_, power_;
  Frame frame_;
};

}  // namespace bdpt::material_testing
