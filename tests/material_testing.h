// What the tests of materials share: materials by name, directions, and integration over the sphere.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "material/material.h"
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

inline Material one_sided(Material m) {
  m.one_sided = true;
  return m;
}

// Those that scatter into more than single directions.
inline std::vector<Named> nonspecular_materials() {
  return {{"diffuse", diffuse()},
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
          {"dielectric 2.4, 1", dielectric(2.4f, 1, 1)}};
}

inline std::vector<Named> specular_materials() {
  return {{"mirror", mirror()},
          {"mirror, one-sided", one_sided(mirror())},
          {"conductor", conductor(0, 0)},
          {"dielectric 1.5", dielectric(1.5f, 0, 0)},
          {"dielectric 0.7", dielectric(0.7f, 0, 0)},
          {"dielectric 1", dielectric(1, 0, 0)},
          {"dielectric 1, rough", dielectric(1, 0.3f, 0.3f)}};
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
