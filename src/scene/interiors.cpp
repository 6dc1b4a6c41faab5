#include "scene/scene.h"

namespace bdpt {

// Only where a medium, a priority or an interface says that it matters.
void Scene::number_enclosures() {
  has_interiors_ = desc_.outside >= 0;
  for (const MaterialDesc& m : desc_.materials) {
    has_passable_ = has_passable_ || m.priority > 0 || m.type == MaterialType::Interface;
    has_interiors_ = has_interiors_ || has_passable_ || m.interior >= 0;
  }
  if (!has_interiors_) return;
  if (desc_.outside >= 0) {
    interiors_.set_outside(desc_.media[size_t(desc_.outside)].get());
    for (const LightDesc& l : desc_.lights)
      if (!l.has_position())
        fail(ErrorCode::InvalidArgument, "the scene has a medium everywhere, and light \"", l.label,
             "\" that comes from infinitely far: none of it could arrive; enclose the medium in a mesh, or remove one");
  }
  size_t count = 0;
  for (MaterialDesc& m : desc_.materials) {
    if (!m.is_boundary() || m.opacity.mode != Opacity::Mode::Opaque) continue;  // what has holes encloses nothing
    if (++count > 0xFFFF) fail(ErrorCode::InvalidArgument, "the scene has more than 65535 materials that light passes");
    Interiors::Enclosure e;
    if (m.interior >= 0) e.medium = desc_.media[size_t(m.interior)].get();
    e.ior = m.ior;
    e.refracts = m.type != MaterialType::Interface;
    e.priority = m.priority;
    m.encloses = interiors_.add(e);
  }
}

Interior Scene::interior_at(const Vec3& p) const {
  if (!has_interiors_) return {};
  constexpr int kMostSurfaces = 100000;
  const Vec3 w = unit(Vec3(0.5773f, 0.6123f, 0.5402f));
  // How often more surfaces are left than entered, in the order of the last leaving: the first left was entered last.
  std::vector<std::pair<uint16_t, int>> left;
  Ray ray{p, std::numeric_limits<float>::infinity(), w};
  for (int i = 0; i < kMostSurfaces; ++i) {
    Hit hit;
    rays_->intersect(&ray, &hit, 1);
    if (hit.instance == kMiss) break;
    Surface s{};
    if (!surface(ray, hit, s)) break;
    if (const uint16_t n = s.material->encloses; n != 0) {
      auto found = std::find_if(left.begin(), left.end(), [&](const auto& l) { return l.first == n; });
      if (found == left.end()) found = left.insert(left.end(), {n, 0});
      found->second += dot(s.ng, w) > 0 ? 1 : -1;
    }
    ray.origin = off_surface(s.p, s.ng, s.margin, w);
  }
  Interior interior;
  for (auto l = left.rbegin(); l != left.rend(); ++l)
    if (l->second > 0 && !interior.is_full()) interior = interior.entered(l->first);
  return interior;
}

// A light is where a point of it is, on its front.
void Scene::find_light_interiors() {
  for (size_t light = 0; light < lights_.count(); ++light) {
    DirectLight d;
    double u = 0;
    const uint32_t triangle = lights_.choose_triangle(int(light), u);
    lights_.place_direct(int(light), {u, triangle, 0.3f, 0.3f}, info_.bounds_max * 2.0f + Vec3(1), d);
    light_interiors_.push_back(d.y0.infinite ? Interior()
                                             : interior_at(off_surface(d.y0.p, d.y0.normal, d.y0.margin, d.y0.normal)));
  }
}

}  // namespace bdpt
