#include "bake/texel_map.h"

#include "sampling/warp.h"

namespace bdpt {

namespace {

// Of twice a texel's area: what is less is a line.
constexpr double kLeastArea = 1e-12;

TexelRect rows_of(const AtlasStack& size, int atlas) {
  return {0, int64_t(atlas) * size.height, size.width, int64_t(atlas + 1) * size.height};
}

// p as corner 0 plus u and v times the edges.
Vec2d barycentric(const UvTriangle& t, const Vec2d& p) {
  const double whole = signed_double_area(t[0], t[1], t[2]);
  return {signed_double_area(t[0], p, t[2]) / whole, signed_double_area(t[0], t[1], p) / whole};
}

Vec2d sample_polygon(const TexelPolygon& polygon, double u0, float u1) {
  double twice = 0;
  for (int i = 2; i < polygon.count; ++i)
    twice += std::fabs(signed_double_area(polygon.corners[0], polygon.corners[i - 1], polygon.corners[i]));
  double left = u0 * twice;
  for (int i = 2;; ++i) {
    const Vec2d &a = polygon.corners[0], &b = polygon.corners[i - 1], &c = polygon.corners[i];
    const double part = std::fabs(signed_double_area(a, b, c));
    if (left < part || i + 1 == polygon.count) {
      const Vec2 s = sample_triangle(float(std::min(left / part, 0x1.fffffep-1)), u1);
      return a + (b - a) * double(s.x) + (c - a) * double(s.y);
    }
    left -= part;
  }
}

}  // namespace

bool TexelMap::triangle(const LightmapInstance& placed, uint32_t primitive, UvTriangle& uv) const {
  const Mesh& mesh = *scene_.mesh(placed.instance);
  const Triangle t = mesh.triangles[primitive];
  const uint32_t corners[3] = {t.a, t.b, t.c};
  for (size_t i = 0; i < 3; ++i) {
    const Vec2 p = mesh.uv[placed.uv_set][corners[i]];
    const Vec2d in_atlas(double(p.x) * double(placed.scale.x) + double(placed.offset.x),
                         double(p.y) * double(placed.scale.y) + double(placed.offset.y));
    uv[i] = to_texels(in_atlas, uint32_t(size_.width), uint32_t(size_.height));
    uv[i].y += double(placed.atlas) * size_.height;
  }
  return std::fabs(signed_double_area(uv[0], uv[1], uv[2])) > kLeastArea;
}

// Calls visit(placed, primitive, texel, area in the atlas, area in the world) for each part of a triangle.
template <class Visit>
void TexelMap::each_part(const PixelRect& subset, Visit&& visit) const {
  for (uint32_t placed = 0; placed < instances_.size(); ++placed) {
    const LightmapInstance& p = instances_[placed];
    const TexelRect atlas = rows_of(size_, p.atlas);
    const TexelRect kept{std::max<int64_t>(atlas.x0, subset.x0), std::max<int64_t>(atlas.y0, subset.y0),
                         std::min<int64_t>(atlas.x1, subset.x1), std::min<int64_t>(atlas.y1, subset.y1)};
    const size_t triangles = scene_.mesh(p.instance)->triangles.size();
    for (uint32_t primitive = 0; primitive < triangles; ++primitive) {
      UvTriangle uv;
      if (!triangle(p, primitive, uv)) continue;
      const double density = scene_.triangle_area(p.instance, primitive) / bdpt::area(uv);
      rasterize(uv, kept, [&](int64_t x, int64_t y, const TexelPolygon& polygon) {
        const double in_atlas = polygon.area();
        visit(placed, primitive, texel(int(x), int(y)), in_atlas, in_atlas * density);
      });
    }
  }
}

// Triangles of which something lies outside of the atlas, or all has no area there.
void TexelMap::report_unmeasured() {
  for (const LightmapInstance& placed : instances_) {
    const TexelRect atlas = rows_of(size_, placed.atlas);
    for (uint32_t primitive = 0; primitive < scene_.mesh(placed.instance)->triangles.size(); ++primitive) {
      UvTriangle uv;
      if (!triangle(placed, primitive, uv)) {
        ++report_.unmapped;
        continue;
      }
      const bool inside = std::all_of(uv.begin(), uv.end(), [&](const Vec2d& c) {
        return c.x >= double(atlas.x0) && c.x <= double(atlas.x1) && c.y >= double(atlas.y0) && c.y <= double(atlas.y1);
      });
      if (inside) continue;
      double part = 0;
      rasterize(uv, atlas,
                [&](int64_t, int64_t, const TexelPolygon& polygon) { part += polygon.area() / bdpt::area(uv); });
      if (part > 1 - 1e-6) continue;  // rounding, at the border
      ++report_.outside;
      report_.area_outside += (1 - part) * scene_.triangle_area(placed.instance, primitive);
    }
  }
}

TexelMap::TexelMap(const Scene& scene, const std::vector<LightmapInstance>& instances, const AtlasStack& size,
                   const PixelRect& subset, const std::shared_ptr<MemoryMeter>& meter)
    : scene_(scene), instances_(instances), size_(size), by_instance_(scene.instance_count(), -1) {
  for (uint32_t placed = 0; placed < instances_.size(); ++placed)
    by_instance_[instances_[placed].instance] = int(placed);
  report_unmeasured();

  const size_t texels = size_t(width()) * size_t(height());
  constexpr size_t kBytes = sizeof(uint64_t) + 4 * sizeof(uint32_t);
  booking_ = Booking(meter, texels * kBytes, "the lightmap's texels");
  first_.assign(texels + 1, 0);
  areas_.assign(texels, 0);
  coverage_.assign(texels, 0);
  numbers_.assign(texels, -1);
  each_part(subset, [&](uint32_t, uint32_t, size_t i, double, double) { ++first_[i + 1]; });
  for (size_t i = 0; i < texels; ++i) first_[i + 1] += first_[i];
  fragments_booking_ = Booking(meter, first_[texels] * sizeof(Fragment), "the lightmap's triangles");
  fragments_.resize(first_[texels]);
  std::vector<uint32_t> filled(texels, 0);
  std::vector<double> covered(texels, 0);
  each_part(subset, [&](uint32_t placed, uint32_t primitive, size_t i, double in_atlas, double in_world) {
    const uint64_t place = first_[i] + filled[i]++;
    fragments_[place] = {placed, primitive, in_world + (place == first_[i] ? 0 : fragments_[place - 1].until)};
    covered[i] += in_atlas;
  });
  for (size_t i = 0; i < texels; ++i) {
    if (first_[i] == first_[i + 1]) continue;
    const Fragment& last = fragments_[first_[i + 1] - 1];
    areas_[i] = float(last.until);
    coverage_[i] = float(covered[i]);
    if (!(areas_[i] > 0)) continue;
    numbers_[i] = int32_t(report_.texels++);
    covered_.push_back(uint32_t(i));
    report_.area += last.until;
    report_.shared += fragments_[first_[i]].placed != last.placed;
  }
}

TexelMap::Point TexelMap::sample(int x, int y, double u0, float u1) const {
  const size_t i = texel(x, y);
  const Fragment* begin = fragments_.data() + first_[i];
  const Fragment* end = fragments_.data() + first_[i + 1];
  const double whole = (end - 1)->until;
  const Fragment* f = end - begin == 1 ? begin
                                       : std::upper_bound(begin, end - 1, u0 * whole,
                                                          [](double v, const Fragment& g) { return v < g.until; });
  const double before = f == begin ? 0 : (f - 1)->until, part = f->until - before;
  u0 = std::clamp((u0 * whole - before) / part, 0.0, 0x1.fffffffffffffp-1);
  UvTriangle uv;
  triangle(instances_[f->placed], f->primitive, uv);
  const TexelPolygon polygon = part_in_texel(uv, x, y);
  // A texel that is covered whole keeps its strata.
  const Vec2d p =
      polygon.count == 4 && polygon.area() == 1 ? Vec2d(x + u0, y + double(u1)) : sample_polygon(polygon, u0, u1);
  const Vec2d b = barycentric(uv, p);
  const double u = std::clamp(b.x, 0.0, 1.0), v = std::clamp(b.y, 0.0, 1 - u);
  return {f->placed, f->primitive, float(u), float(v)};
}

bool TexelMap::find(const LightmapInstance& placed, uint32_t primitive, float u, float v, int& x, int& y) const {
  UvTriangle uv;
  if (!triangle(placed, primitive, uv)) return false;
  const Vec2d point = uv[0] + (uv[1] - uv[0]) * double(u) + (uv[2] - uv[0]) * double(v);
  const TexelRect atlas = rows_of(size_, placed.atlas);
  const int64_t column = int64_t(std::floor(point.x)), row = int64_t(std::floor(point.y));
  if (column < atlas.x0 || column >= atlas.x1 || row < atlas.y0 || row >= atlas.y1) return false;
  x = int(column), y = int(row);
  return area(x, y) > 0;
}

}  // namespace bdpt
