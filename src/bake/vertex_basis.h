// The light that arrives at surfaces, by the vertices of their meshes (Veach 10.6, with hat functions for a basis):
//   E_j = INT h_j E dA / INT h_j dA,   h_j = 1 at vertex j, 0 at all others, linear on each triangle
// Eye subpaths of vertex j start with the density h_j / INT h_j. A light subpath that lands at x belongs to vertex j of
// its triangle with probability h_j(x): h_j is in the chance of both sides, and their ratio is that of 1 / INT h_j.
#pragma once

#include "bake/rows.h"
#include "bake/surface_sensor.h"
#include "base/memory.h"

#include <array>
#include <memory>

namespace bdpt {

// Vertices are numbered through all instances, in their order; each one's are those of its mesh.
class VertexBasis final : public SurfaceSensor {
 public:
  VertexBasis(std::shared_ptr<const Scene> scene, const std::vector<ReceivingInstance>& instances,
              const std::vector<OutputDesc>& outputs, bool geometric_normals,
              const std::shared_ptr<MemoryMeter>& meter);

  uint64_t vertices() const { return areas_.size(); }
  double area(uint64_t vertex) const { return areas_[vertex]; }  // INT h_j; 0 of a vertex of no triangle
  // The values at the vertices of the function between them, linear on each triangle, whose means by h_j are nearest to
  // these: M v = b, M_ij = INT h_i h_j dA, b_j = INT h_j E_j. One channel of several that lie side by side.
  void solve(float* values, uint32_t channel, uint32_t channels) const;

  int width() const override { return rows_.width; }
  int height() const override { return rows_.height; }
  uint64_t hash() const override { return hash_; }
  bool lands_by_chance() const override { return true; }
  int64_t number(int x, int y) const override {
    const int64_t vertex = rows_.number(x, y);
    return vertex < 0 ? -1 : numbers_[size_t(vertex)];
  }
  uint64_t count() const override { return measured_.size(); }
  void find(uint64_t number, int& x, int& y) const override {
    const FilmPosition place = rows_.place(measured_[number]);
    x = int(place.x), y = int(place.y);
  }

  EyeStart start_at(int x, int y, const float u[5]) const override;
  bool land(const Landing& landing, SensorPoint& z0) const override;

 private:
  // A vertex's part of a triangle.
  struct Corner {
    uint32_t placed, primitive;
    uint32_t corner;  // 0, 1 or 2
    double until;     // area of the vertex's triangles up to this one
  };
  struct Placed : ReceivingInstance {
    uint64_t first;  // its first vertex
  };
  template <class Visit>
  void each_triangle(Visit&& visit) const;
  void collect();

  std::vector<Placed> placed_;
  std::vector<int> by_instance_;
  Rows rows_;
  std::vector<double> areas_;
  std::vector<uint64_t> first_;  // corner of each vertex, and one more
  std::vector<Corner> corners_;
  std::vector<int64_t> numbers_;    // among those that are measured; -1 for others
  std::vector<uint64_t> measured_;  // vertices by these numbers
  uint64_t hash_;
  Booking booking_;
};

}  // namespace bdpt
