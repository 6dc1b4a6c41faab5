// Instances of curves.
#include "scene/scene.h"

namespace bdpt {

bool Scene::curve_surface(const Instance& instance, const Ray& ray, const Hit& hit, Surface& s) const {
  CurvePlace place;
  const Vec3 found = instance.inverse.point(ray.origin + ray.direction * hit.t);
  if (!instance.curves->place(hit.primitive, hit.u, found, place)) return false;
  const Vec3 n = instance.inverse.transposed(place.normal);
  const float stretch = length(n);  // of distances along the normal, from the world to the curves' unit
  if (!(stretch > 0)) return false;
  s.p = instance.transform.point(place.p);
  s.ng = s.ns = n * (1 / stretch);
  s.margin = margin_of(instance.transform.magnitude(place.p)) + place.margin / stretch;
  s.tangent = instance.transform.vector(place.along);
  return true;
}

// What cannot be on curves: they enclose nothing for certain, cubic ones being open at their ends, and nothing varies
// across them.
void Scene::check_curves(const InstanceDesc& desc) const {
  const auto refuse = [&](const char* why) {
    fail(ErrorCode::InvalidArgument, "instance \"", desc.label, "\" is of curves, but its material ", why,
         ": use a mesh, or another material");
  };
  const MaterialDesc& material = desc_.materials[size_t(desc.material)];
  if (!is_black(material.emission)) refuse("emits light, which shines from meshes and spheres alone");
  const auto check = [&](const MaterialDesc& m) {
    if (m.is_boundary()) refuse("refracts or is an INTERFACE, and so needs a closed surface");
    for (const TextureUse& use : m.textures)
      if (use.slot == Slot::Normal || use.slot == Slot::Bump)
        refuse("has a texture of slot NORMAL or BUMP, for which a surface must vary in two directions");
  };
  check(material);
  if (material.type == MaterialType::Mix)
    for (int part : material.mixed) check(desc_.materials[size_t(part)]);
}

}  // namespace bdpt
