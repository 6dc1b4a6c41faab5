#include "lightmap/claims.h"

#include "base/error.h"

namespace bdpt {
namespace {

// Layers of triangles over the whole atlas; the work grows with them.
constexpr double kMaxLayers = 256;

struct ChartTriangle {
  uint32_t mesh;
  size_t triangle;
};

// The triangles of the atlas that have an area there, chart by chart.
std::vector<std::vector<ChartTriangle>> by_chart(const std::vector<UvMesh>& meshes, const Charts& charts) {
  std::vector<std::vector<ChartTriangle>> result(charts.count);
  for (uint32_t m = 0; m < meshes.size(); ++m)
    for (size_t t = 0; t < charts.of_triangles[m].size(); ++t)
      if (const uint32_t chart = charts.of_triangles[m][t]; chart && !has_no_uv_area(meshes[m], t))
        result[chart - 1].push_back({m, t});
  return result;
}

double area_inside(const UvTriangle& triangle, const Atlas& atlas) {
  TexelPolygon polygon;
  polygon.count = 3;
  std::copy(triangle.begin(), triangle.end(), polygon.corners);
  polygon = uv_raster::clip(uv_raster::clip(polygon, 0, 0, 1), 0, atlas.width, -1);
  polygon = uv_raster::clip(uv_raster::clip(polygon, 1, 0, 1), 1, atlas.height, -1);
  return polygon.area();
}

void check_layers(const std::vector<std::vector<ChartTriangle>>& charts, const std::vector<UvMesh>& meshes,
                  const Atlas& atlas) {
  double area = 0;
  for (const auto& chart : charts)
    for (const ChartTriangle& t : chart) area += area_inside(meshes[t.mesh].uv(t.triangle), atlas);
  const double layers = area / double(atlas.texels());
  if (layers > kMaxLayers)
    fail(ErrorCode::InvalidArgument, "the triangles cover the atlas ", layers,
         " times, which no unwrapping does: give the uv set made for lightmaps, and each instance its own rectangle by "
         "uv_scale and uv_offset");
}

bool reaches_into(const TexelPolygon& polygon, int64_t x, int64_t y) {
  const double low[2] = {double(x) + kTexelTolerance, double(y) + kTexelTolerance};
  const double high[2] = {double(x + 1) - kTexelTolerance, double(y + 1) - kTexelTolerance};
  for (int axis = 0; axis < 2; ++axis)
    if (polygon.high(axis) < low[axis] || polygon.low(axis) > high[axis]) return false;
  return true;
}

}  // namespace

Claims find_claims(const std::vector<UvMesh>& meshes, const Charts& charts, const Atlas& atlas) {
  const std::vector<std::vector<ChartTriangle>> triangles = by_chart(meshes, charts);
  check_layers(triangles, meshes, atlas);
  Claims claims{std::vector<uint32_t>(atlas.texels()), std::vector<uint32_t>(atlas.texels())};
  std::vector<float> largest(atlas.texels());
  std::vector<double> areas(atlas.texels());  // of the chart in hand; zero elsewhere
  std::vector<size_t> touched;
  for (uint32_t chart = 1; chart <= charts.count; ++chart) {
    for (const ChartTriangle& t : triangles[chart - 1])
      rasterize(meshes[t.mesh].uv(t.triangle), atlas.bounds(), [&](int64_t x, int64_t y, const TexelPolygon& polygon) {
        if (!reaches_into(polygon, x, y)) return;
        double& area = areas[atlas.texel(x, y)];
        if (area == 0) touched.push_back(atlas.texel(x, y));
        area += polygon.area();
      });
    for (const size_t texel : touched) {
      ++claims.counts[texel];
      if (const float area = float(areas[texel]); area > largest[texel]) {
        largest[texel] = area;
        claims.charts[texel] = chart;
      }
      areas[texel] = 0;
    }
    touched.clear();
  }
  return claims;
}

}  // namespace bdpt
