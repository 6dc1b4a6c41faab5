// What a mesh that shines by a texture keeps: in each triangle a table of cells, by the brightest texel of each.
#pragma once

#include "geometry/texture.h"
#include "light/mesh.h"

#include <array>
#include <memory>
#include <vector>

namespace bdpt {

class TexturedMesh : public LightData {
 public:
  // uv: of each triangle's corners.
  TexturedMesh(const std::vector<LightTriangle>& mesh, const std::vector<std::array<Vec2, 3>>& uv,
               std::shared_ptr<const Texture> texture, const TextureSampler& sampler);

  // What triangles are chosen by: area times brightness, a bound of it.
  const std::vector<double>& weights() const { return weights_; }
  // The integral of brightness over the area, about.
  double mean() const { return mean_; }
  // Where meshes keep the triangles.
  void place_among(const LightMeshes& meshes, uint32_t first) { meshes_ = &meshes, first_ = first; }

  const LightMeshes& meshes() const { return *meshes_; }
  Rgb radiance(const LightPoint& y0) const;
  // A place in a triangle, as barycentric coordinates of its second and third corner; its density per area, and that
  // of choosing the triangle, too.
  Vec2 sample(uint32_t triangle, double rest, float u1, float u2) const;
  float density_in_triangle(const LightPoint& y0) const;
  float density(const LightPoint& y0) const;

 private:
  struct Part {
    std::array<Vec2, 3> uv;
    uint32_t first_cell, side;  // side: edges of cells along an edge of the triangle
    float probability, inverse_area;
  };
  Rgb lookup(const Part& part, const Vec2& b) const;
  void add_cells(Part& part, double area, const class LargestTexels& largest, uint32_t most);

  std::shared_ptr<const Texture> texture_;
  TextureSampler sampler_;
  std::vector<Part> parts_;
  std::vector<uint32_t> sums_;  // of each triangle, up to and with each cell: whole numbers, see TexelTable
  std::vector<double> weights_;
  double mean_ = 0;
  const LightMeshes* meshes_ = nullptr;
  uint32_t first_ = 0;
};

}  // namespace bdpt
