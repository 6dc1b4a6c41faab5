#include "bake/texel_map.h"

#include "sampling/warp.h"

#include <numeric>

namespace bdpt {

namespace {

// Of twice a texel's area: what is less is a line.
constexpr double kLeastArea = 1e-12;
constexpr int kCells = 8;  // along the side of a texel: chi has a bit for each
constexpr uint64_t kOpen = ~uint64_t(0);
constexpr double kLeastOpen = 1e-6;  // of a texel's area: what is less is buried

TexelRect rows_of(const AtlasStack& size, int atlas) {
  return {0, int64_t(atlas) * size.height, size.width, int64_t(atlas + 1) * size.height};
}

// p as corner 0 plus u and v times the edges.
Vec2d barycentric(const UvTriangle& t, const Vec2d& p) {
  const double whole = signed_double_area(t[0], t[1], t[2]);
  return {signed_double_area(t[0], p, t[2]) / whole, signed_double_area(t[0], t[1], p) / whole};
}

Vec2d centroid(const TexelPolygon& polygon) {
  Vec2d sum(0, 0);
  double twice = 0;
  for (int i = 2; i < polygon.count; ++i) {
    const Vec2d &a = polygon.corners[0], &b = polygon.corners[i - 1], &c = polygon.corners[i];
    const double part = std::fabs(signed_double_area(a, b, c));
    sum += (a + b + c) * (part / 3);
    twice += part;
  }
  return sum / twice;
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
        visit(placed, primitive, texel(int(x) - window_.x0, int(y) - window_.y0), in_atlas, in_atlas * density);
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

TexelMap::TexelMap(const Scene& scene, const LightmapDesc& desc)
    : scene_(scene),
      instances_(desc.instances),
      size_(desc.size),
      window_(desc.window()),
      by_instance_(scene.instance_count(), -1) {}

uint64_t TexelMap::bytes_for(uint64_t texels, uint64_t fragments, bool with_chi) {
  constexpr uint64_t kTexel = sizeof(uint64_t) + 4 * sizeof(uint32_t), kChi = sizeof(uint64_t);
  return texels * (kTexel + (with_chi ? sizeof(float) : 0)) + fragments * (sizeof(Fragment) + (with_chi ? kChi : 0));
}

std::vector<uint64_t> TexelMap::count_fragments(const Scene& scene, const LightmapDesc& desc) {
  const TexelMap map(scene, desc);
  std::vector<uint64_t> rows(uint64_t(map.height()));
  map.each_part(desc.subset, [&](uint32_t, uint32_t, size_t i, double, double) { ++rows[i / size_t(map.width())]; });
  return rows;
}

TexelMap::TexelMap(const Scene& scene, const LightmapDesc& desc, const std::shared_ptr<MemoryMeter>& meter)
    : TexelMap(scene, desc) {
  for (uint32_t placed = 0; placed < instances_.size(); ++placed)
    by_instance_[instances_[placed].instance] = int(placed);
  report_unmeasured();

  const size_t texels = size_t(width()) * size_t(height());
  const bool with_chi = desc.burial.rays > 0;
  booking_ = Booking(meter, bytes_for(texels, 0, with_chi), "the lightmap's texels");
  first_.assign(texels + 1, 0);
  areas_.assign(texels, 0);
  coverage_.assign(texels, 0);
  numbers_.assign(texels, -1);
  each_part(desc.subset, [&](uint32_t, uint32_t, size_t i, double, double) { ++first_[i + 1]; });
  for (size_t i = 0; i < texels; ++i) first_[i + 1] += first_[i];
  fragments_booking_ = Booking(meter, bytes_for(0, first_[texels], with_chi), "the lightmap's triangles");
  fragments_.resize(first_[texels]);
  std::vector<uint32_t> filled(texels, 0);
  std::vector<double> covered(texels, 0);
  each_part(desc.subset, [&](uint32_t placed, uint32_t primitive, size_t i, double in_atlas, double in_world) {
    const uint64_t place = first_[i] + filled[i]++;
    fragments_[place] = {placed, primitive, in_world + (place == first_[i] ? 0 : fragments_[place - 1].until)};
    covered[i] += in_atlas;
  });
  for (size_t i = 0; i < texels; ++i) {
    if (first_[i] == first_[i + 1]) continue;
    areas_[i] = float(fragments_[first_[i + 1] - 1].until);
    coverage_[i] = float(covered[i]);
  }
  if (with_chi) bury(desc.burial);
  for (size_t i = 0; i < texels; ++i) {
    if (!(areas_[i] > 0)) continue;
    const Fragment& last = fragments_[first_[i + 1] - 1];
    numbers_[i] = int32_t(report_.texels++);
    covered_.push_back(uint32_t(i));
    report_.area += last.until;
    report_.shared += fragments_[first_[i]].placed != last.placed;
  }
}

template <class Visit>
void TexelMap::each_cell(const Fragment& fragment, int x, int y, Visit&& visit) const {
  UvTriangle uv;
  triangle(instances_[fragment.placed], fragment.primitive, uv);
  for (Vec2d& corner : uv) corner *= kCells;
  const int64_t left = int64_t(x + window_.x0) * kCells, top = int64_t(y + window_.y0) * kCells;
  const TexelRect cells{left, top, left + kCells, top + kCells};
  rasterize(uv, cells, [&](int64_t cx, int64_t cy, const TexelPolygon& polygon) {
    visit(uint64_t(1) << ((cy - cells.y0) * kCells + (cx - cells.x0)), polygon);
  });
}

// Finds chi, and takes what is buried out of the areas.
void TexelMap::bury(const BurialDesc& desc) {
  const size_t texels = areas_.size();
  chi_.assign(fragments_.size(), kOpen);
  buried_.assign(texels, 0);
  const Burial burial(scene_, desc);
  std::vector<double> row_areas(areas_.size() / size_t(width()));
  const auto row = [&](uint32_t y) { row_areas[y] = bury_row(burial, int(y)); };
  if (desc.parallel)
    desc.parallel(uint32_t(height()), row);
  else
    for (int y = 0; y < height(); ++y) row(uint32_t(y));
  for (size_t i = 0; i < texels; ++i) report_.buried += buried_[i] > 0 && !(areas_[i] > 0);
  report_.area_buried = std::accumulate(row_areas.begin(), row_areas.end(), 0.0);
}

double TexelMap::bury_row(const Burial& burial, int y) {
  double area = 0;
  std::vector<Burial::Place> places;
  std::vector<uint64_t> bits;
  for (int x = 0; x < width(); ++x) {
    const size_t t = texel(x, y);
    bool any = false;
    for (size_t i = first_[t]; i < first_[t + 1]; ++i) {
      const Fragment& f = fragments_[i];
      const LightmapInstance& placed = instances_[f.placed];
      places.clear();
      bits.clear();
      UvTriangle uv;
      triangle(placed, f.primitive, uv);
      each_cell(f, x, y, [&](uint64_t bit, const TexelPolygon& polygon) {
        const Vec2d b = barycentric(uv, centroid(polygon) / kCells);
        const double u = std::clamp(b.x, 0.0, 1.0), v = std::clamp(b.y, 0.0, 1 - u);
        Surface surface{};
        if (!scene_.point(placed.instance, f.primitive, float(u), float(v), surface)) return;
        places.push_back({surface.p, placed.flip ? -surface.ng : surface.ng, surface.margin});
        bits.push_back(bit);
      });
      if (!burial.suspects(places)) continue;
      const std::vector<uint8_t> buried = burial.test(places);
      for (size_t k = 0; k < bits.size(); ++k)
        if (buried[k]) chi_[i] &= ~bits[k], any = true;
    }
    if (any) area += bury_closed(x, y);
  }
  return area;
}

// Makes a texel's areas follow its fragments' chi; what they lose, in the world.
double TexelMap::bury_closed(int x, int y) {
  const size_t t = texel(x, y);
  double until = 0, before = 0, open = 0;
  for (size_t i = first_[t]; i < first_[t + 1]; ++i) {
    Fragment& f = fragments_[i];
    const double whole = f.until - before;
    before = f.until;
    double cells = 0, open_cells = 0;
    each_cell(f, x, y, [&](uint64_t bit, const TexelPolygon& polygon) {
      const double part = polygon.area();
      cells += part;
      if (chi_[i] & bit) open_cells += part;
    });
    until += chi_[i] == kOpen || !(cells > 0) ? whole : whole * (open_cells / cells);
    f.until = until;
    open += open_cells / (kCells * kCells);
  }
  if (until < kLeastOpen * before) {  // slivers of cells
    for (size_t i = first_[t]; i < first_[t + 1]; ++i) chi_[i] = 0, fragments_[i].until = 0;
    until = open = 0;
  }
  areas_[t] = float(until);
  buried_[t] = float(double(coverage_[t]) - open);
  coverage_[t] = float(open);
  return before - until;
}

bool TexelMap::is_open(uint32_t placed, uint32_t primitive, const Vec2d& point, size_t texel) const {
  const auto begin = fragments_.begin() + int64_t(first_[texel]), end = fragments_.begin() + int64_t(first_[texel + 1]);
  const auto f = std::lower_bound(begin, end, std::pair(placed, primitive), [](const Fragment& a, const auto& b) {
    return std::pair(a.placed, a.primitive) < b;
  });
  if (f == end || f->placed != placed || f->primitive != primitive) return false;  // rounding, at a border
  const int column = int(std::floor(point.x * kCells)) & (kCells - 1);
  const int row = int(std::floor(point.y * kCells)) & (kCells - 1);
  return chi_[size_t(f - fragments_.begin())] >> (row * kCells + column) & 1;
}

// A point of a fragment's open cells, in texels.
Vec2d TexelMap::sample_open(const Fragment& fragment, uint64_t chi, int x, int y, double u0, float u1) const {
  TexelPolygon parts[kCells * kCells];
  int count = 0;
  double whole = 0;
  each_cell(fragment, x, y, [&](uint64_t bit, const TexelPolygon& polygon) {
    if (!(chi & bit)) return;
    parts[count++] = polygon;
    whole += polygon.area();
  });
  double left = u0 * whole;
  for (int i = 0;; ++i) {
    const double part = parts[i].area();
    if (left < part || i + 1 == count)
      return sample_polygon(parts[i], std::clamp(left / part, 0.0, 0x1.fffffep-1), u1) / kCells;
    left -= part;
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
  const int column = x + window_.x0, row = y + window_.y0;
  Vec2d p;
  if (const uint64_t chi = chi_.empty() ? kOpen : chi_[size_t(f - fragments_.data())]; chi != kOpen) {
    p = sample_open(*f, chi, x, y, u0, u1);
  } else {
    const TexelPolygon polygon = part_in_texel(uv, column, row);
    // A texel that is covered whole keeps its strata.
    p = polygon.count == 4 && polygon.area() == 1 ? Vec2d(column + u0, row + double(u1))
                                                  : sample_polygon(polygon, u0, u1);
  }
  const Vec2d b = barycentric(uv, p);
  const double u = std::clamp(b.x, 0.0, 1.0), v = std::clamp(b.y, 0.0, 1 - u);
  return {f->placed, f->primitive, float(u), float(v)};
}

bool TexelMap::find(uint32_t index, uint32_t primitive, float u, float v, int& x, int& y) const {
  const LightmapInstance& placed = instances_[index];
  UvTriangle uv;
  if (!triangle(placed, primitive, uv)) return false;
  const Vec2d point = uv[0] + (uv[1] - uv[0]) * double(u) + (uv[2] - uv[0]) * double(v);
  const TexelRect atlas = rows_of(size_, placed.atlas);
  const int64_t column = int64_t(std::floor(point.x)), row = int64_t(std::floor(point.y));
  if (column < atlas.x0 || column >= atlas.x1 || row < atlas.y0 || row >= atlas.y1) return false;
  if (column < window_.x0 || column >= window_.x1 || row < window_.y0 || row >= window_.y1) return false;
  x = int(column) - window_.x0, y = int(row) - window_.y0;
  return area(x, y) > 0 && (chi_.empty() || is_open(index, primitive, point, texel(x, y)));
}

}  // namespace bdpt
