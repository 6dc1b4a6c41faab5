#include "bake/lightmap.h"

#include "bake/rows.h"
#include "sampling/hash.h"

namespace bdpt {

Lightmap::Lightmap(std::shared_ptr<const Scene> scene, const LightmapDesc& desc, const std::vector<OutputDesc>& outputs,
                   const std::shared_ptr<MemoryMeter>& meter)
    : SurfaceSensor(std::move(scene), desc.instances, outputs, desc.geometric_normals),
      texels_(*scene_, desc, meter),
      atlas_width_(desc.size.width) {
  const PixelRect& subset = desc.subset;
  hash_ = hash_combine(base_hash(), hash_values(desc.size.width, desc.size.height, desc.size.count, subset.x0,
                                                subset.y0, subset.x1, subset.y1));
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
  EyeStart s = start_on(texels_.placed(point.placed), point.primitive, point.u, point.v, u + 2);
  s.film = center_of(x, y);
  s.density_position = 1 / texels_.area(x, y);
  return s;
}

bool Lightmap::land(const Landing& landing, SensorPoint& z0) const {
  int x, y;
  const int index = texels_.placed_index(landing.instance);
  if (index < 0) return false;
  if (!receive(texels_.placed(uint32_t(index)), landing, z0) ||
      !texels_.find(uint32_t(index), landing.primitive, landing.u, landing.v, x, y))
    return false;
  z0.film = center_of(x, y);
  z0.importance = z0.density_position = 1 / texels_.area(x, y);
  return true;
}

}  // namespace bdpt
