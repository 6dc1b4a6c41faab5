// A mesh that shines by a texture.
#include "light/textured_mesh.h"

#include "light/area.h"
#include "light/kinds.h"
#include "light/largest_texels.h"

namespace bdpt {

namespace {

// A triangle is cut into side² cells of one shape, half of them upside down: row i, then pairs along it.
uint32_t cell_of(uint32_t side, const Vec2& b) {
  const float x = b.x * float(side), y = b.y * float(side);
  const uint32_t i = std::min(uint32_t(std::max(x, 0.0f)), side - 1);
  const uint32_t j = std::min(uint32_t(std::max(y, 0.0f)), side - 1 - i);
  const bool upside_down = j < side - 1 - i && (x - float(i)) + (y - float(j)) > 1;
  return i * (2 * side - i) + 2 * j + upside_down;
}

struct Cell {
  uint32_t i, j;
  bool upside_down;
};
Cell cell_at(uint32_t side, uint32_t index) {
  // Row i begins at i (2 side - i).
  uint32_t i = uint32_t(double(side) - std::sqrt(double(side) * side - index));
  while (i > 0 && i * (2 * side - i) > index) --i;
  while ((i + 1) * (2 * side - (i + 1)) <= index && i + 1 < side) ++i;
  const uint32_t along = index - i * (2 * side - i);
  return {i, along / 2, along % 2 == 1};
}

// Of its bound, what a cell is taken to send at least, though its middle be black.
constexpr double kLeastPart = 0.02;

// A place of the cell, b in its own coordinates.
Vec2 within(uint32_t side, const Cell& c, const Vec2& b) {
  const float x = c.upside_down ? 1 - b.x : b.x, y = c.upside_down ? 1 - b.y : b.y;
  return Vec2(float(c.i) + x, float(c.j) + y) * (1 / float(side));
}

}  // namespace

TexturedMesh::TexturedMesh(const std::vector<LightTriangle>& mesh, const std::vector<std::array<Vec2, 3>>& uv,
                           std::shared_ptr<const Texture> texture, const TextureSampler& sampler)
    : texture_(std::move(texture)), sampler_(sampler) {
  constexpr double kMostCells = 0x1p22;
  const uint32_t most = uint32_t(std::clamp(std::sqrt(kMostCells / double(mesh.size())), 1.0, 512.0));
  const LargestTexels largest(*texture_, sampler_);
  double total = 0;
  for (size_t k = 0; k < mesh.size(); ++k) {
    Part part{uv[k], 0, 1, 0, 0};
    const double area = mesh[k].area();
    add_cells(part, area, largest, most);
    part.inverse_area = area > 0 ? float(1 / area) : 0;
    total += weights_.back();
    parts_.push_back(part);
  }
  if (!(total > 0)) {  // black: as if it were white, so that it can be chosen where all lights are
    for (size_t k = 0; k < mesh.size(); ++k) total += weights_[k] = mesh[k].area();
  }
  for (size_t k = 0; k < mesh.size(); ++k) parts_[k].probability = float(weights_[k] / total);
}

void TexturedMesh::add_cells(Part& part, double area, const LargestTexels& largest, uint32_t most) {
  float extent = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec2 edge = part.uv[size_t(i)] - part.uv[size_t((i + 1) % 3)];
    extent =
        std::max({extent, std::fabs(edge.x) * float(texture_->width()), std::fabs(edge.y) * float(texture_->height())});
  }
  part.side = extent < float(most) ? std::max(1u, uint32_t(std::ceil(extent))) : most;
  part.first_cell = uint32_t(sums_.size());
  const uint32_t cells = part.side * part.side;
  std::vector<double> bounds;
  double sum = 0;
  for (uint32_t index = 0; index < cells; ++index) {
    const Cell c = cell_at(part.side, index);
    Vec2 low(1e30f), high(-1e30f);
    for (const Vec2& corner : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}) {
      const Vec2 b = within(part.side, c, corner);
      const Vec2 uv = part.uv[0] * (1 - b.x - b.y) + part.uv[1] * b.x + part.uv[2] * b.y;
      low = Vec2(std::min(low.x, uv.x), std::min(low.y, uv.y));
      high = Vec2(std::max(high.x, uv.x), std::max(high.y, uv.y));
    }
    bounds.push_back(double(largest.within(low, high)));
    const Vec2 middle = within(part.side, c, Vec2(1 / 3.0f, 1 / 3.0f));
    const Rgb seen = lookup(part, middle);
    mean_ += area / double(cells) * std::max(double(norm(seen)), kLeastPart * bounds.back());
    sum += bounds.back();
  }
  uint32_t units = 0;
  for (double b : bounds) {
    if (b > 0) units += 1 + uint32_t(b / sum * 0x1p31);
    sums_.push_back(units);
  }
  weights_.push_back(area * sum / double(cells));
}

Rgb TexturedMesh::lookup(const Part& part, const Vec2& b) const {
  return to_rgb(texture_->lookup(part.uv[0] * (1 - b.x - b.y) + part.uv[1] * b.x + part.uv[2] * b.y, sampler_));
}

Rgb TexturedMesh::radiance(const LightPoint& y0) const { return lookup(parts_[y0.primitive], y0.b); }

Vec2 TexturedMesh::sample(uint32_t triangle, double rest, float u1, float u2) const {
  const Part& part = parts_[triangle - first_];
  const Vec2 b = sample_triangle(u1, u2);
  const uint32_t cells = part.side * part.side;
  const uint32_t* sums = &sums_[part.first_cell];
  if (sums[cells - 1] == 0) return b;  // black
  const uint32_t at = uint32_t(rest * double(sums[cells - 1]));
  const uint32_t index = uint32_t(std::upper_bound(sums, sums + cells - 1, at) - sums);
  return within(part.side, cell_at(part.side, index), b);
}

float TexturedMesh::density_in_triangle(const LightPoint& y0) const {
  const Part& part = parts_[y0.primitive];
  const uint32_t cells = part.side * part.side, index = cell_of(part.side, y0.b);
  const uint32_t* sums = &sums_[part.first_cell];
  if (sums[cells - 1] == 0) return part.inverse_area;
  const uint32_t below = index > 0 ? sums[index - 1] : 0;
  return float(sums[index] - below) / float(sums[cells - 1]) * float(cells) * part.inverse_area;
}

float TexturedMesh::density(const LightPoint& y0) const {
  return parts_[y0.primitive].probability * density_in_triangle(y0);
}

namespace {

const TexturedMesh& mesh_of(const Light& light) { return static_cast<const TexturedMesh&>(*light.data); }

double power(const Light& light) { return double(norm(light.radiance)) * reach_of_area(light, mesh_of(light).mean()); }

void place(const Light& light, const PlaceNumbers& u, const Vec3&, LightPoint& y0) {
  const TexturedMesh& mesh = mesh_of(light);
  mesh.meshes().place(light, u.triangle, mesh.sample(u.triangle, u.rest, u.u1, u.u2), y0);
}

void start(const Light& light, const StartNumbers& u, LightStart& start) {
  place(light, u, {}, start.y0);
  start_from_area(light, u.v1, u.v2, start);
}

Rgb emitted(const Light& light, const LightPoint& y0, const Vec3& w) {
  const Rgb white = emitted_by_area(light, y0, w);
  return is_black(white) ? white : white * mesh_of(light).radiance(y0);
}

float position_density(const Light& light, const LightPoint& y0) { return mesh_of(light).density(y0); }
float direct_density(const Light& light, const LightPoint& y0, const Vec3&) { return mesh_of(light).density(y0); }
float density_in_triangle(const Light& light, const LightPoint& y0) { return mesh_of(light).density_in_triangle(y0); }

Emitter bounds(const Light& light, uint32_t triangle) {
  const TexturedMesh& mesh = mesh_of(light);
  Emitter e = mesh.meshes().bounds(light, triangle);
  e.intensity = double(norm(light.radiance)) * mesh.weights()[triangle - light.first];
  return e;
}

}  // namespace

const LightKind kTexturedMeshLight = {
    .has_area = true,
    .infinite = false,
    .hittable = true,
    .is_mesh = true,
    .power = power,
    .start = start,
    .place = place,
    .emitted = emitted,
    .position_density = position_density,
    .direction_density = direction_density_of_area,
    .direct_density = direct_density,
    .density_in_triangle = density_in_triangle,
    .bounds = bounds,
};

}  // namespace bdpt
