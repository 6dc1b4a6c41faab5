// A mesh that shines, on the front of its triangles or on both sides.
#include "light/mesh.h"

#include "light/area.h"
#include "light/kinds.h"

namespace bdpt {

void LightMeshes::add(const std::vector<LightTriangle>& mesh, const std::vector<double>& weights, Light& light) {
  light.first = uint32_t(triangles_.size());
  light.triangles = uint32_t(mesh.size());
  double total = 0, sum = 0;
  for (double w : weights) total += w;
  for (size_t k = 0; k < mesh.size(); ++k) {
    triangles_.push_back(mesh[k]);
    triangles_.back().below = sum / total;
    sum += weights[k];
  }
  const LightTriangle* triangle = &triangles_[light.first];
  for (uint32_t k = 0, i = 0; k < light.triangles; ++k) {
    while (i + 1 < light.triangles && triangle[i + 1].below <= double(k) / light.triangles) ++i;
    guide_.push_back(i);
  }
}

uint32_t LightMeshes::choose(const Light& light, double& u) const {
  constexpr uint32_t kFew = 4;
  if (light.triangles < 2) return light.first;
  const LightTriangle* triangle = &triangles_[light.first];
  uint32_t k = light.triangles > kFew ? guide_[light.first + size_t(u * double(light.triangles))] : 0;
  while (k > 0 && triangle[k].below > u) --k;  // the table's place is rounded
  while (k + 1 < light.triangles && triangle[k + 1].below <= u) ++k;
  const double above = k + 1 < light.triangles ? triangle[k + 1].below : 1;
  u = std::clamp((u - triangle[k].below) / (above - triangle[k].below), 0.0, 0x1.fffffffffffffp-1);
  return light.first + k;
}

float LightMeshes::density(const Light& light, const LightPoint& y0) const {
  const LightTriangle& t = triangles_[light.first + y0.primitive];
  return 2 / length(cross(t.edge1, t.edge2));
}

Emitter LightMeshes::bounds(const Light& light, uint32_t triangle) const {
  const LightTriangle& t = triangles_[triangle];
  Emitter e;
  e.triangle = triangle;
  e.low = e.high = t.corner;
  for (const Vec3& corner : {t.corner + t.edge1, t.corner + t.edge2}) {
    e.low = Vec3(std::min(e.low.x, corner.x), std::min(e.low.y, corner.y), std::min(e.low.z, corner.z));
    e.high = Vec3(std::max(e.high.x, corner.x), std::max(e.high.y, corner.y), std::max(e.high.z, corner.z));
  }
  e.axis = t.normal;
  e.cos_o = 1;
  e.intensity = double(norm(light.radiance)) * t.area();
  e.two_sided = light.two_sided;
  return e;
}

namespace {

const LightMeshes& meshes_of(const Light& light) { return static_cast<const LightMeshes&>(*light.data); }

void place(const Light& light, const PlaceNumbers& u, const Vec3&, LightPoint& y0) {
  meshes_of(light).place(light, u.triangle, sample_triangle(u.u1, u.u2), y0);
}

void start(const Light& light, const StartNumbers& u, LightStart& start) {
  place(light, u, {}, start.y0);
  start_from_area(light, u.v1, u.v2, start);
}

float position_density(const Light& light, const LightPoint&) { return light.inverse_area; }
float direct_density(const Light& light, const LightPoint&, const Vec3&) { return light.inverse_area; }
float density_in_triangle(const Light& light, const LightPoint& y0) { return meshes_of(light).density(light, y0); }
Emitter bounds(const Light& light, uint32_t triangle) { return meshes_of(light).bounds(light, triangle); }

}  // namespace

const LightKind kMeshLight = {
    .has_area = true,
    .infinite = false,
    .hittable = true,
    .is_mesh = true,
    .power = power_of_area,
    .start = start,
    .place = place,
    .emitted = emitted_by_area,
    .position_density = position_density,
    .direction_density = direction_density_of_area,
    .direct_density = direct_density,
    .density_in_triangle = density_in_triangle,
    .bounds = bounds,
};

}  // namespace bdpt
