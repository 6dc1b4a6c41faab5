// The triangles of all meshes that shine.
#pragma once

#include "light/light.h"

#include <vector>

namespace bdpt {

// One triangle of an area light, in the world. All that choosing a point needs is in one cache line.
struct alignas(64) LightTriangle {
  Vec3 corner, edge1, edge2;
  Vec3 normal;       // unit, toward the front; zero where the triangle is degenerate
  double below = 0;  // part of its mesh's weights that lies before it
  float margin;
  double area() const { return length_squared(normal) > 0 ? 0.5 * double(length(cross(edge1, edge2))) : 0; }
  LightTriangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& n, float m)
      : corner(a), edge1(b - a), edge2(c - a), normal(n), margin(m) {}
};

class LightMeshes : public LightData {
 public:
  // Sets the light's place among them. Triangles will be chosen by their weights.
  void add(const std::vector<LightTriangle>& mesh, const std::vector<double>& weights, Light& light);
  // The triangle of a mesh that u chooses, numbered over all meshes; u is stretched back to [0,1). (Not from the mesh's
  // first, so that it can be fetched before the light is.)
  uint32_t choose(const Light& light, double& u) const;
  // The point of a triangle with these barycentric coordinates of its second and third corner.
  void place(const Light& light, uint32_t triangle, const Vec2& b, LightPoint& y0) const {
    const LightTriangle& t = triangles_[triangle];
    y0.primitive = triangle - light.first;
    y0.b = b;
    y0.p = t.corner + t.edge1 * b.x + t.edge2 * b.y;
    y0.normal = t.normal;
    y0.margin = t.margin;
  }
  // Of a triangle of the light's that is chosen.
  float density(const Light& light, const LightPoint& y0) const;
  Emitter bounds(const Light& light, uint32_t triangle) const;

 private:
  std::vector<LightTriangle> triangles_;
  std::vector<uint32_t> guide_;  // where in a mesh to look for part k / n of its weights; for each triangle k
};

}  // namespace bdpt
