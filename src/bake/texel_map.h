// Which parts of which triangles a texel covers. Eye subpaths start in these parts, by their area in the world; A_j is
// their sum. Of what is buried no technique knows: the part of a triangle in a texel has a bit for each of 8 x 8 cells
// of the texel, chi, made once; starts, landings and A_j all follow it.
#pragma once

#include "bake/burial.h"
#include "bake/receiving_instance.h"
#include "base/memory.h"
#include "math/uv_raster.h"
#include "scene/scene.h"
#include "sensor/sensor.h"

#include <memory>
#include <vector>

namespace bdpt {

// An instance of the scene and its place in an atlas: texture coordinates are scaled and moved there.
struct LightmapInstance : ReceivingInstance {
  int atlas = 0;
  int uv_set = 1;
  Vec2 scale{1, 1}, offset{0, 0};
};

// Atlases of one size, one below the other.
struct AtlasStack {
  int width = 1, height = 1, count = 1;
};

// The texels that a lightmap measures.
struct LightmapDesc {
  std::vector<LightmapInstance> instances;
  AtlasStack size;
  PixelRect subset;           // the texels to keep, in rows of all atlases
  bool film_of_rect = false;  // the film has these texels alone
  BurialDesc burial = {};
  bool geometric_normals = false;

  // What the film has.
  PixelRect window() const { return film_of_rect ? subset : PixelRect{0, 0, size.width, size.height * size.count}; }
};

class TexelMap {
 public:
  // A point of a surface.
  struct Point {
    uint32_t placed;  // index of the LightmapInstance
    uint32_t primitive;
    float u, v;  // barycentric coordinates of the second and third vertex
  };
  struct Report {
    uint64_t texels = 0;      // that cover some surface
    uint64_t shared = 0;      // of these, more than one instance's
    uint64_t unmapped = 0;    // triangles without area in the atlas
    uint64_t outside = 0;     // triangles that reach outside of the atlas
    double area = 0;          // of the surface covered
    double area_outside = 0;  // of the mapped surface that lies outside
    uint64_t buried = 0;      // texels that cover surface, but all of it buried
    double area_buried = 0;   // of the surface left out for being buried
  };

  TexelMap(const Scene& scene, const LightmapDesc& desc, const std::shared_ptr<MemoryMeter>& meter);
  // What the meter would count for so many texels and fragments of theirs.
  static uint64_t bytes_for(uint64_t texels, uint64_t fragments, bool with_chi);
  // How many fragments each row has of a map that was not made.
  static std::vector<uint64_t> count_fragments(const Scene& scene, const LightmapDesc& desc);

  // Texels are told by their place in the window.
  const PixelRect& window() const { return window_; }
  int width() const { return window_.width(); }
  int height() const { return window_.y1 - window_.y0; }
  const Report& report() const { return report_; }
  const LightmapInstance& placed(uint32_t i) const { return instances_[i]; }
  // A_j; 0 where a texel covers no surface.
  float area(int x, int y) const { return areas_[texel(x, y)]; }
  // The part of a texel, by its area in the atlas, that is covered; above 1 where surfaces overlap.
  float coverage(int x, int y) const { return coverage_[texel(x, y)]; }
  // The same of what is buried, which the two above leave out.
  float buried(int x, int y) const { return buried_.empty() ? 0 : buried_[texel(x, y)]; }
  // The number of a texel among those that cover some surface; -1 for others.
  int64_t number(int x, int y) const { return numbers_[texel(x, y)]; }
  void find(uint64_t number, int& x, int& y) const {
    x = int(covered_[number] % uint32_t(width())), y = int(covered_[number] / uint32_t(width()));
  }
  // A point of what texel (x, y) covers, uniform by area.
  Point sample(int x, int y, double u0, float u1) const;
  // The texel in which a point of the surface lies; false where none does, or the point is buried.
  bool find(uint32_t placed, uint32_t primitive, float u, float v, int& x, int& y) const;
  // Index of the LightmapInstance; -1 where an instance is not mapped.
  int placed_index(uint32_t instance) const { return by_instance_[instance]; }

 private:
  struct Fragment {
    uint32_t placed, primitive;
    double until;  // area of the texel's fragments up to this one
  };
  TexelMap(const Scene& scene, const LightmapDesc& desc);
  size_t texel(int x, int y) const { return size_t(y) * size_t(width()) + size_t(x); }
  template <class Visit>
  void each_part(const PixelRect& subset, Visit&& visit) const;
  void report_unmeasured();
  void bury(const BurialDesc& burial);
  double bury_row(const Burial& burial, int y);
  double bury_closed(int x, int y);
  // The parts of a fragment in cells, in eighths of texels: visit(bit of chi, polygon).
  template <class Visit>
  void each_cell(const Fragment& fragment, int x, int y, Visit&& visit) const;
  Vec2d sample_open(const Fragment& fragment, uint64_t chi, int x, int y, double u0, float u1) const;
  bool is_open(uint32_t placed, uint32_t primitive, const Vec2d& point, size_t texel) const;
  // The triangle in texels of all atlases; false where it has no area.
  bool triangle(const LightmapInstance& placed, uint32_t primitive, UvTriangle& uv) const;

  const Scene& scene_;
  std::vector<LightmapInstance> instances_;
  AtlasStack size_;
  PixelRect window_;
  std::vector<int> by_instance_;
  std::vector<uint64_t> first_;  // fragment of each texel, and one more
  std::vector<Fragment> fragments_;
  std::vector<uint64_t> chi_;  // of each fragment; empty where nothing was looked for
  std::vector<float> areas_, coverage_, buried_;
  std::vector<int32_t> numbers_;
  std::vector<uint32_t> covered_;  // texels by their numbers
  Report report_;
  Booking booking_, fragments_booking_;
};

}  // namespace bdpt
