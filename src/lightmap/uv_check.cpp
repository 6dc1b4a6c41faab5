#include "lightmap/uv_check.h"

#include "lightmap/overlap.h"
#include "lightmap/padding.h"

#include <cmath>

namespace bdpt {
namespace {

bool is_outside(const UvTriangle& triangle, const Vec2d& low, const Vec2d& high) {
  for (const Vec2d& p : triangle)
    for (int axis = 0; axis < 2; ++axis)
      if (!(p[axis] >= low[axis] - kTexelTolerance && p[axis] <= high[axis] + kTexelTolerance)) return true;
  return false;
}

// Triangles without area on either side have no density.
struct Density {
  double texels = 0, world = 0;
  double least = 0, greatest = 0;

  void add(double texel_area, double world_area) {
    const double density = std::sqrt(texel_area / world_area);
    least = world == 0 ? density : std::min(least, density);
    greatest = std::max(greatest, density);
    texels += texel_area;
    world += world_area;
  }
  double mean() const { return world > 0 ? std::sqrt(texels / world) : 0; }
};

void count_triangles(const std::vector<UvMesh>& meshes, const Atlas& atlas, UvCheck& check) {
  Density density;
  for (const UvMesh& mesh : meshes) {
    if (mesh.atlas != atlas.number) continue;
    check.triangles += mesh.triangles.size();
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
      const UvTriangle uv = mesh.uv(i);
      check.outside_rect += is_outside(uv, mesh.rect_low, mesh.rect_high);
      check.outside_atlas += is_outside(uv, Vec2d(0, 0), Vec2d(atlas.width, atlas.height));
      const bool no_uv = has_no_uv_area(mesh, i), no_world = has_no_world_area(mesh, i);
      check.without_uv_area += no_uv;
      check.without_world_area += no_world;
      // Rows go down where v goes up: a triangle that is not mirrored turns from x away from y.
      if (!no_uv) check.mirrored += signed_double_area(uv[0], uv[1], uv[2]) * mesh.handedness > 0;
      if (!no_uv && !no_world) density.add(area(uv), mesh.world_area(i));
    }
  }
  check.density_min = density.least;
  check.density_mean = density.mean();
  check.density_max = density.greatest;
}

void count_texels(UvCheck& check) {
  for (const uint32_t n : check.claims.counts) {
    check.texels_claimed += n > 0;
    check.texels_shared += n > 1;
  }
}

// Adds one to each texel of a pair's common polygon.
class OverlapMap {
 public:
  OverlapMap(const Atlas& atlas, std::vector<uint32_t>& counts) : atlas_(atlas), counts_(counts) {
    counts_.assign(atlas.texels(), 0);
    last_pair_.assign(atlas.texels(), 0);
  }
  void add(const UvOverlap& overlap) {
    ++pair_;
    for (size_t i = 2; i < overlap.corners.size(); ++i)
      rasterize({overlap.corners[0], overlap.corners[i - 1], overlap.corners[i]}, atlas_.bounds(),
                [&](int64_t x, int64_t y, const TexelPolygon&) {
                  const size_t texel = atlas_.texel(x, y);
                  counts_[texel] += last_pair_[texel] != pair_;
                  last_pair_[texel] = pair_;
                });
  }

 private:
  const Atlas& atlas_;
  std::vector<uint32_t>& counts_;
  std::vector<uint64_t> last_pair_;
  uint64_t pair_ = 0;
};

void count_overlaps(const std::vector<UvMesh>& meshes, const UvCheckOptions& options, UvCheck& check) {
  std::vector<UvTriangle> triangles;
  std::vector<uint32_t> charts;
  for (size_t m = 0; m < meshes.size(); ++m)
    for (size_t t = 0; t < meshes[m].triangles.size(); ++t)
      if (meshes[m].atlas == options.atlas.number && !has_no_uv_area(meshes[m], t)) {
        triangles.push_back(meshes[m].uv(t));
        charts.push_back(check.triangle_charts.of_triangles[m][t]);
      }
  std::optional<OverlapMap> map;
  if (options.map_overlaps) map.emplace(options.atlas, check.texel_overlaps);
  for_each_overlap(triangles, options.atlas.height, [&](const UvOverlap& overlap) {
    check.overlaps_cut = check.overlaps_within + check.overlaps_between == options.max_overlaps;
    if (check.overlaps_cut) return false;
    const bool within = charts[overlap.a] == charts[overlap.b];
    ++(within ? check.overlaps_within : check.overlaps_between);
    (within ? check.overlap_area_within : check.overlap_area_between) += overlap.area;
    if (map) map->add(overlap);
    return true;
  });
}

}  // namespace

UvCheck check_uv(const std::vector<UvMesh>& meshes, const UvCheckOptions& options) {
  UvCheck check;
  count_triangles(meshes, options.atlas, check);
  check.triangle_charts = find_charts(meshes, options.atlas.number);
  check.charts = check.triangle_charts.count;
  check.claims = find_claims(meshes, check.triangle_charts, options.atlas);
  count_texels(check);
  check.padding = smallest_padding(check.claims, options.atlas, options.padding_reach);
  count_overlaps(meshes, options, check);
  return check;
}

}  // namespace bdpt
