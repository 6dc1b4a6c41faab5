// Subpaths and connections where media count: distances are sampled, and rays pass boundaries that are nothing but
// that.
#include "transport/block.h"

#include <bit>

namespace bdpt {

void Block::travel(size_t walker) {
  const Walker& w = walkers_[walker];
  const Ray& ray = rays_[walker];
  const Hit& hit = hits_[walker];
  const Scene& scene = engine_.scene;
  const Medium* const medium = scene.interiors().medium(w.interior);
  const bool miss = hit.instance == kMiss;
  const float end = miss ? kInfinity : hit.t;
  float scattering = kInfinity;
  if (medium && medium->scatters()) {
    Four u = draw(w.eye, w.sample, w.count, Purpose::Distance);
    // The numbers of further stretches follow from the first.
    if (const uint32_t n = w.passage.stretches(); n > 0) {
      const uint64_t h = hash_values(std::bit_cast<uint32_t>(u[2]), std::bit_cast<uint32_t>(u[3]), n);
      u.u[0] = float(h >> 40) * 0x1p-24f;
      u.u[1] = float(h & 0xFFFFFF) * 0x1p-24f;
    }
    scattering = medium->sample_distance(u[0], u[1]);
  }
  if (!w.eye && engine_.hit_sensor) hit_sensor(w, ray, std::min(end, scattering), medium);

  Walker on = w;
  if (scattering < end) {
    if (end_passage(on, medium, scattering, true)) arrive_in(on, *medium, ray.origin + ray.direction * scattering);
    return;
  }
  if (miss) {
    if (medium && !is_black(medium->sigma_t())) return;  // nothing comes from infinitely far
    if (end_passage(on, nullptr, 0, false)) escape(on);
    return;
  }
  Surface surface;
  if (!scene.surface(ray, hit, surface)) return;
  const bool from_front = dot(surface.ng, w.direction) < 0;
  if (scene.is_passed(*surface.material, w.interior, from_front)) {
    on.passage.add(medium, hit.t);
    if (!Scene::enter_or_leave(on.interior, surface.material->encloses, from_front)) return reject_walk(w);
    push_walker(next_walkers_, next_rays_, on, off_surface(surface.p, surface.ng, surface.margin, w.direction));
    return;
  }
  if (!end_passage(on, medium, hit.t, false)) return;
  if (!shade(walker, surface)) return;
  if (surface.material->encloses != 0) {  // its index is relative to what is round it
    const Interior round = from_front ? w.interior : w.interior.left(surface.material->encloses);
    if (const float ior = scene.interiors().ior(round); ior != 1) {
      Material& own = (w.eye ? eye_.materials : light_.materials).add(*surface.material);
      own.ior /= ior;
      own.film_ior /= ior, own.film_thickness *= ior;
      surface.material = &own;
    }
  }
  arrive_on(on, hit, surface);
}

bool Block::end_passage(Walker& w, const Medium* medium, float length, bool in_medium) const {
  w.passage.add(medium, length);
  const float density = w.passage.density_to(in_medium);
  if (!(density > 0)) return false;
  w.throughput *= w.passage.transmittance() * (1 / density);
  return true;
}

void Block::arrive_in(const Walker& w, const Medium& medium, const Vec3& p) {
  const float geometry = w.infinite ? 1 : w.cosine / length_squared(p - w.origin);
  Vertex* const added = add_vertex(w, p, geometry, true);
  if (!added) return;
  Vertex& v = *added;
  v.margin = 0;
  v.ng = v.ns = v.tangent = Vec3(0);
  v.previous_cosine_g = v.previous_cosine_s = 1;
  v.reflectance = Rgb(0);
  v.material = nullptr;
  v.medium = &medium;
  v.joinable = true;
  weigh_vertex(w, v);
  if (v.count >= w.most) return;

  const Four u = draw(w.eye, w.sample, v.count, Purpose::Scatter);
  const Vec3 next = medium.sample_phase(v.previous, u[0], u[1]);
  const float phase = medium.phase(v.previous, next);
  Rgb factor = medium.sigma_s;
  // What is left of light here: the stretch's transmittance over its density is part of it.
  const float local = norm(medium.sigma_s * w.passage.transmittance()) / w.passage.density_to(true);
  if (survives_roulette(v, local, u[3], factor)) walk_on(w, v, next, factor, {phase, phase, 1}, v.interior);
}

Interior Block::interior_toward(const Vertex& v, const Vec3& w) const {
  Interior interior = v.interior;
  if (v.in_medium() || v.is_sensor() || dot(v.ng, w) * v.previous_cosine_g > 0) return interior;
  Scene::enter_or_leave(interior, v.material->encloses,
                        v.previous_cosine_g > 0);  // where four are there, no walk goes on
  return interior;
}

bool Block::passes(Interior interior, Ray& ray, float length, Passage& passage) {
  const Scene& scene = engine_.scene;
  if (!scene.has_passable()) {
    if (std::isfinite(length)) passage.add(scene.interiors().medium(interior), length);
    return true;
  }
  const Vec3 end = ray.origin + ray.direction * ray.tmax, w = unit(ray.direction);
  const bool infinite = std::isinf(length);
  Ray rest = ray;
  for (;;) {
    const Medium* const medium = scene.interiors().medium(interior);
    Hit hit;
    scene.rays().intersect(&rest, &hit, 1);
    if (hit.instance == kMiss) {
      if (infinite && medium && !is_black(medium->sigma_t())) return false;
      passage.add(infinite ? nullptr : medium, infinite ? 0 : bdpt::length(end - rest.origin));
      ray.tmax = 0;
      return true;
    }
    Surface surface;
    if (!scene.surface(rest, hit, surface)) return false;
    const bool from_front = dot(surface.ng, w) < 0;
    if (!scene.is_passed(*surface.material, interior, from_front) ||
        !Scene::enter_or_leave(interior, surface.material->encloses, from_front))
      return false;
    passage.add(medium, bdpt::length(surface.p - rest.origin));
    rest.origin = off_surface(surface.p, surface.ng, surface.margin, w);
    if (!infinite) {
      rest.direction = end - rest.origin;
      if (!(dot(rest.direction, w) > 0)) {
        ray.tmax = 0;
        return true;
      }
    }
  }
}

void Block::reject_walk(const Walker& w) {
  ++stats_.rejected;
  if (!keeps_ && w.eye) engine_.film.reject(eye_.starts[w.sample].film);
}

}  // namespace bdpt
