#include "bake/lightmap.h"

#include "sampling/hash.h"

#include <algorithm>

namespace bdpt {

namespace {

bool has_normals(const Scene& scene, const std::vector<LightmapInstance>& instances) {
  for (const LightmapInstance& i : instances)
    if (!scene.mesh(i.instance)->normals.empty()) return true;
  return false;
}

}  // namespace

Lightmap::Lightmap(std::shared_ptr<const Scene> scene, const LightmapDesc& desc, const std::vector<OutputDesc>& outputs,
                   const std::shared_ptr<MemoryMeter>& meter)
    : scene_(std::move(scene)),
      texels_(*scene_, desc, meter),
      atlas_width_(desc.size.width),
      outputs_(outputs),
      geometric_normals_(desc.geometric_normals || !has_normals(*scene_, desc.instances)),
      responds_(outputs_.respond(true, !geometric_normals_)),
      hittable_(std::all_of(desc.instances.begin(), desc.instances.end(),
                            [&](const LightmapInstance& i) { return scene_->is_visible(i.instance); })),
      hemisphere_(all_fade(outputs) && geometric_normals_ ? 1 : 0.5f) {
  const PixelRect& subset = desc.subset;
  hash_ = hash_values(scene_->info().hash, desc.size.width, desc.size.height, desc.size.count, subset.x0, subset.y0,
                      subset.x1, subset.y1, geometric_normals_);
  hash_ = hash_combine(hash_, outputs_.hash());
  if (desc.film_of_rect) hash_ = hash_combine(hash_, 1);
  if (const BurialDesc& burial = desc.burial; burial.rays > 0) {
    hash_ = hash_combine(hash_, hash_values(burial.rays, burial.all_backs));
    hash_ = hash_bytes(&burial.tolerance, sizeof(burial.tolerance), hash_);
  }
  for (const LightmapInstance& i : desc.instances) {
    const float place[] = {i.scale.x, i.scale.y, i.offset.x, i.offset.y};
    hash_ = hash_bytes(place, sizeof(place), hash_combine(hash_, hash_values(i.instance, i.atlas, i.uv_set, i.flip)));
  }
}

EyeStart Lightmap::start_at(int x, int y, const float u[5]) const {
  const TexelMap::Point point = texels_.sample(x, y, double(u[0]), u[1]);
  const LightmapInstance& placed = texels_.placed(point.placed);
  Surface surface{};
  scene_->point(placed.instance, point.primitive, point.u, point.v, surface);
  const float side = placed.flip ? -1.0f : 1.0f;
  EyeStart s;
  s.film = center_of(x, y);
  s.p = surface.p;
  s.normal = surface.ng * side;
  s.shading = geometric_normals_ ? s.normal : surface.ns * side;
  s.margin = surface.margin;
  s.density_position = 1 / texels_.area(x, y);
  hemisphere_.start(u + 2, s);
  return s;
}

bool Lightmap::look(const EyeStart& z0, const Vec3& w, SensorDirection& direction) const {
  return hemisphere_.look(z0.normal, w, direction);
}

bool Lightmap::land(const Landing& landing, SensorPoint& z0) const {
  int x, y;
  const int index = texels_.placed_index(landing.instance);
  if (index < 0) return false;
  const LightmapInstance& placed = texels_.placed(uint32_t(index));
  const float side = placed.flip ? -1.0f : 1.0f;
  z0.normal = landing.ng * side;
  const float cosine = -dot(z0.normal, landing.direction);
  if (!(cosine > 0) || !texels_.find(uint32_t(index), landing.primitive, landing.u, landing.v, x, y)) return false;
  z0.shading = geometric_normals_ ? z0.normal : landing.ns * side;
  z0.film = center_of(x, y);
  z0.p = landing.p;
  z0.density_position = 1 / texels_.area(x, y);
  z0.density_direction = hemisphere_.density(cosine);
  z0.importance = z0.density_position;
  return true;
}

void Lightmap::respond(const SensorPlace& place, const Vec3& w, float* response) const {
  outputs_.evaluate(w, place.shading, dot(place.normal, w), response);
}

}  // namespace bdpt
