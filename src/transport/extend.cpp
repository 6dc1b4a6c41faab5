// The stage `extend`: subpaths grow, and what needs no subpath of the other side is joined or counted on the way.
#include "transport/block.h"
#include "transport/stage_timer.h"

namespace bdpt {

namespace {

constexpr float kMostLikely = 0.95f;  // that a walk goes on where roulette is played

}  // namespace

void Block::extend() {
  if (responses_.unshadowed() && !keeps_) {
    StageTimer timer(stats_.connect);
    for (uint32_t sample = 0; sample < eye_.count(); ++sample) measure_unshadowed(sample);
  }
  if (engine_.allows(1, 1)) {
    StageTimer timer(stats_.connect);
    if (engine_.local) {
      for (uint32_t sample = 0; sample < eye_.count(); ++sample)
        if (takes(1, 1, sample) && eye_.starts[sample].weight_position != 0)
          connect_to_light(sensor_vertex(sample), sample);
    } else {
      for (uint32_t light = 0; light < light_.count(); ++light)
        if (takes(1, 1, light)) connect_start_to_sensor(light);
    }
  }
  while (!walkers_.empty()) {
    {
      StageTimer timer(stats_.extend);
      trace();
      next_walkers_.clear();
      next_rays_.clear();
      arrivals_.clear();
      for (size_t i = 0; i < walkers_.size(); ++i) {
        const Walker& w = walkers_[i];
        ++(w.eye ? stats_.eye_rays : stats_.light_rays);
        if (w.eye && w.count == 1 && responses_.sees()) see(w, rays_[i], hits_[i]);
        if (engine_.media) {
          travel(w, rays_[i], hits_[i]);
          continue;
        }
        if (!w.eye && engine_.hit_sensor) {
          const float tmax = hits_[i].instance == kMiss ? kInfinity : hits_[i].t;
          engine_.cross ? cross_sensor(w, rays_[i], tmax) : hit_sensor(w, rays_[i], tmax);
        }
        if (hits_[i].instance == kMiss)
          escape(w);
        else
          arrive(w, rays_[i], hits_[i]);
      }
      std::swap(walkers_, next_walkers_);
      std::swap(rays_, next_rays_);
    }
    connect_ends();
    // A walker carries all that its weights need: a plan that joins no inner vertices has no use for them.
    if (!keeps_vertices()) eye_.clear_vertices(), light_.clear_vertices();
  }
  shadow();
}

// What the vertices just made can be joined to without knowing of any subpath of the other side. The shadow rays are
// cast now, not when there are many: the order in which a sample's contributions are added must not depend on others.
void Block::connect_ends() {
  {
    const OuterStageTimer timer(stats_.connect, stats_);
    for (const Arrival& a : arrivals_) {
      const Vertex& v = a.eye ? eye_.vertices[a.vertex] : light_.vertices[a.vertex];
      if (!v.joinable) continue;
      if (a.eye) {
        if (takes(1, v.count, a.sample) && !is_black(v.throughput)) connect_to_light(v, a.sample);
      } else if (takes(v.count, 1, a.sample)) {
        if (!engine_.local)
          connect_to_sensor(v, a.sample);
        else if (!strategy_->joins_inner() && !is_black(v.throughput))
          connect_to_own_start(v, a.sample);
      }
      flush_if_full();  // one vertex of each subpath: its contributions keep their order
    }
  }
  shadow();
}

void Block::trace() {
  StageTimer timer(stats_.extend_rays);
  hits_.resize(rays_.size());
  engine_.scene.rays().intersect(rays_.data(), hits_.data(), rays_.size());
  if (engine_.recorder) engine_.recorder->record(rays_.data(), rays_.size(), false);
}

// u_i of mis.h, for the technique that would join this vertex to the one before it, unless this one scatters by a
// Dirac.
float Block::technique(const Walker& w, const Vertex& v) const {
  if (w.specular || !v.joinable) return 0;
  const TechniqueClasses& c = (w.eye ? *strategy_ : engine_.strategy).classes;
  if (w.count > 1) return c.inner;
  return w.eye ? c.t1 : c.s1 * v.direct;
}

void Block::arrive(const Walker& w, const Ray& ray, const Hit& hit) {
  Surface surface;
  if (!engine_.scene.surface(ray, hit, surface)) return;
  engine_.scene.shade(hit, surface, w.eye ? eye_.materials : light_.materials);
  arrive_on(w, hit, surface);
}

Vertex* Block::add_vertex(const Walker& w, const Vec3& p, float geometry, bool in_medium) {
  const float density = w.projected * geometry * w.passage.density_to(in_medium);
  if (!(density > 0) || !std::isfinite(density)) return nullptr;
  std::vector<Vertex>& vertices = w.eye ? eye_.vertices : light_.vertices;
  const uint32_t index = uint32_t(vertices.size());
  (w.eye ? eye_.last : light_.last)[w.sample] = index;
  arrivals_.push_back({index, w.sample, w.eye});
  Vertex& v = vertices.emplace_back();
  v.p = p;
  v.density = density;
  v.geometry = geometry * w.passage.density_back(w.in_medium);
  if (engine_.cross && w.eye && w.count == 1)
    v.geometry *= along_way(eye_.starts[w.sample], w.direction, length(p - w.origin));
  v.sums = v.geometry / w.density * w.sums;
  v.outer = v.geometry / w.density * w.outer;
  v.previous = -w.direction;
  v.previous_reverse = 0;
  v.throughput = w.throughput;
  v.previous_index = w.vertex;
  v.previous_density = w.density;
  v.interior = w.interior;
  v.count = w.count + 1;
  v.specular = false;
  v.direct = w.direct;
  v.start_hittable = w.start_hittable;
  v.start_finite = w.start_finite;
  v.group = w.group;
  return &v;
}

// What a vertex needs that was just told what it lies on.
void Block::weigh_vertex(const Walker& w, Vertex& v) {
  if (!w.eye && w.count == 1 && v.joinable) {
    const LightStart& y0 = light_.starts[w.sample];
    v.direct = engine_.direct_lighting.density(y0.y0, v.receiver()) / y0.density_position;
  }
  v.technique = technique(w, v);
}

void Block::arrive_on(const Walker& w, const Hit& hit, const Surface& surface) {
  if (w.eye && w.count == 1 && responses_.sees_surfaces() && !keeps_) see_surface(w, hit, surface);
  const float cosine = absdot(surface.ng, w.direction);
  const float geometry = w.infinite ? cosine : w.cosine * cosine / length_squared(surface.p - w.origin);
  Vertex* const added = add_vertex(w, surface.p, geometry, false);
  if (!added) return;
  Vertex& v = *added;
  v.margin = surface.margin;
  v.ng = surface.ng;
  v.ns = surface.ns;
  v.tangent = surface.tangent;
  v.previous_cosine_g = -dot(v.ng, w.direction);
  v.previous_cosine_s = -dot(v.ns, w.direction);
  v.reflectance = surface.reflectance;
  v.material = surface.material;
  v.medium = nullptr;
  v.joinable = !surface.material->is_specular();
  weigh_vertex(w, v);

  if (!w.eye && engine_.land) land(w, hit, v);
  if (w.eye && surface.light >= 0 && takes(0, v.count, w.sample)) {
    LightPoint x0;
    x0.light = surface.light;
    x0.primitive = surface.primitive;
    x0.b = Vec2(hit.u, hit.v);
    x0.has_area = x0.hittable = true;
    x0.p = v.p;
    x0.normal = v.ng;
    const Rgb radiance = engine_.scene.lights().emitted(x0, v.previous);
    if (!is_black(radiance)) hit_light(w, v, x0, radiance);
  }
  if (v.count < w.most) continue_walk(w, v);
}

void Block::see(const Walker& w, const Ray& ray, const Hit& hit) {
  const bool miss = hit.instance == kMiss;
  Surface surface;
  const bool back = !miss && engine_.scene.surface(ray, hit, surface) && surface.material->one_sided &&
                    dot(surface.ng, w.direction) > 0;
  responses_.see(w.sample, eye_.starts[w.sample], miss ? kInfinity : hit.t, back, w.throughput.r,
                 [&](size_t plane, const Rgb& value) {
                   eye_sums_[w.sample * responses_.planes() + plane] += value * eye_weights_[w.sample];
                 });
}

void Block::escape(const Walker& w) {
  const Lights& lights = engine_.scene.lights();
  if (!w.eye || lights.hittable_infinite().empty() || !takes(0, w.count + 1, w.sample)) return;
  LightPoint x0;
  x0.infinite = x0.hittable = true;
  x0.normal = w.direction;
  Vertex z{};
  // A direction has no area: the edge's factor is the cosine at its other end.
  z.geometry = w.cosine * w.passage.density_back(w.in_medium);
  z.density = w.projected * w.cosine * w.passage.density_to(false);
  if (engine_.cross && w.count == 1) z.geometry *= along_way(eye_.starts[w.sample], w.direction, kInfinity);
  z.sums = w.count == 1 && !engine_.local ? 0 : z.geometry / w.density * w.sums;  // no (2,0): see hit_sensor
  z.previous = -w.direction;
  z.throughput = w.throughput;
  z.previous_index = w.vertex;
  z.previous_density = w.density;
  z.count = w.count + 1;
  for (int light : lights.hittable_infinite()) {  // each light's paths are its own
    x0.light = light;
    const Rgb radiance = lights.emitted(x0, z.previous);
    if (!is_black(radiance)) hit_light(w, z, x0, radiance);
  }
}

// s = 0: the eye subpath ends at z = x_0, on a light.
void Block::hit_light(const Walker& w, const Vertex& z, const LightPoint& x0, const Rgb& radiance) {
  const Lights& lights = engine_.scene.lights();
  const bool corner = z.count == 2, at_camera = corner && !engine_.local;
  const float position = lights.position_density(x0, engine_.light_choice());
  const float direction = lights.direction_density(x0, w.origin, z.previous);
  const float direct = at_camera    ? position
                       : w.specular ? 0
                                    : engine_.direct_lighting.density(x0, {w.origin, w.normal});
  float weight = 1;
  if (engine_.running_sums) {
    // u_1 is that of s = 1 here, seen from the eye: P_A^d(x_0) takes the place of P_A(x_0).
    const TechniqueClasses& c = strategy_->classes;
    const float count = w.specular || (at_camera && x0.infinite) ? 0 : corner ? c.corner : c.s1;
    weight = engine_.heuristic.weight(
        0, engine_.heuristic.combine(count * direct, position * direction * z.sums) / z.density);
  } else if (!engine_.unweighted) {
    Edge edge;
    edge.light_at_z = position;
    edge.light_before_z = direction * z.geometry;
    weight = path_weight(nullptr, &z, 0, z.count, edge, {}, {}, position > 0 ? direct / position : 0, true,
                         engine_.local || !x0.infinite, light_, *strategy_);
  }
  add_eye(w.sample, 0, z.count, w.throughput * radiance * weight, lights.group(x0.light));
}

// t = 0: the light subpath passes through the sensor, which is no surface of the scene; it is counted and goes on.
// tmax: where it meets something, or scatters in the medium.
void Block::hit_sensor(const Walker& w, const Ray& ray, float tmax, const Medium* medium) {
  // Not straight from a light without a point: its rays need not cover a lens that lies outside of the scene.
  if (w.infinite) return;
  const uint32_t s = w.count + 1;
  if (!takes(s, 0, w.sample)) return;
  SensorPoint z0;
  if (!engine_.hit_camera(ray, tmax, z0)) return;
  Walker at = w;
  if (engine_.media && !end_passage(at, medium, length(z0.p - ray.origin), false)) return;
  const float geometry = w.cosine * absdot(z0.normal, w.direction) / length_squared(z0.p - w.origin);
  const float density = w.projected * geometry * at.passage.density_to(false);
  if (density > 0 && std::isfinite(density))
    add_arrival(at, z0, geometry * at.passage.density_back(w.in_medium), density);
}

// t = 0 in volumes: counted at one point of the way through each, if the light comes so far.
void Block::cross_sensor(const Walker& w, const Ray& ray, float tmax) {
  const uint32_t s = w.count + 1;
  if (!takes(s, 0, w.sample)) return;
  crossings_.clear();
  engine_.sensor.cross(ray.origin, ray.direction, tmax, crossings_);
  for (const Crossing& c : crossings_) {
    const double length = c.end - c.begin;
    const Four u = engine_.draw(another(light_.streams[w.sample], c.number + 1), w.count, Purpose::Connect);
    const double t = c.begin + double(u[0]) * length;
    if (!(t < double(tmax))) continue;
    SensorPoint z0 = engine_.sensor.point_in(c.number, ray.origin + ray.direction * float(t));
    z0.importance *= float(length);
    const float geometry = w.infinite ? 1 : w.cosine / length_squared(z0.p - w.origin);
    const float density = float(double(w.projected * geometry) / length);
    if (density > 0 && std::isfinite(density)) add_arrival(w, z0, geometry, density);
  }
}

// t = 0 on a surface of the scene, that of y: light counts there, and scatters.
void Block::land(const Walker& w, const Hit& hit, const Vertex& y) {
  if (!takes(y.count, 0, w.sample)) return;
  SensorPoint z0;
  const uint64_t id = engine_.scene.instance_id(hit.instance);
  const float chance = engine_.sensor.lands_by_chance() ? draw(false, w.sample, y.count, Purpose::Connect)[0] : 0;
  if (engine_.sensor.land({hit.instance, hit.primitive, id, hit.u, hit.v, y.p, y.ng, y.ns, w.direction, chance}, z0))
    add_arrival(w, z0, y.geometry, y.density);
}

void Block::add_arrival(const Walker& w, const SensorPoint& z0, float geometry, float density) {
  const uint32_t s = w.count + 1;
  const Strategy& strategy = engine_.strategy_at(z0.film);
  if (!strategy.allows(s, 0)) return;
  const bool corner = w.count == 1;
  float direct = w.direct;
  if (corner && engine_.local) {
    const LightStart& y0 = light_.starts[w.sample];
    direct = engine_.direct_lighting.density(y0.y0, {z0.p, z0.normal}) / y0.density_position;
  }
  float weight = 1;
  if (engine_.running_sums) {
    const TechniqueClasses& c = strategy.classes;
    const float count = w.specular ? 0 : !corner ? c.t1 : engine_.local ? c.corner * direct : c.corner;
    const float sums = geometry / w.density * (engine_.uses_outer(strategy) ? w.outer : w.sums);
    weight = engine_.heuristic.weight(
        z0.density_position / (density * c.t0) * engine_.heuristic.combine(count, z0.density_direction * sums), 0);
  } else if (!engine_.unweighted) {
    Vertex y{};
    y.density = density;
    y.geometry = geometry;
    y.previous_index = w.vertex;
    y.previous_density = w.density;
    Edge edge;
    edge.eye_at_y = z0.density_position;
    edge.eye_before_y = z0.density_direction * geometry;
    weight = path_weight(&y, nullptr, s, 0, edge, {}, {}, direct, w.start_hittable, engine_.local || w.start_finite,
                         light_, strategy);
  }
  const Vec3 from = -w.direction;
  add_light(w.sample, z0.film, s, 0, w.throughput * (z0.importance * weight / strategy.counts.of(int(s), 0)), w.group,
            &z0, &from);
}

void Block::continue_walk(const Walker& w, Vertex& v) {
  const TransportMode mode = w.eye ? TransportMode::Radiance : TransportMode::Importance;
  const Four u = draw(w.eye, w.sample, v.count, Purpose::Scatter);
  const float gp = v.previous_cosine_g, sp = v.previous_cosine_s;
  if (!(gp * sp > 0)) return;
  const Frame frame = v.material->is_anisotropic() ? Frame(v.ns, v.tangent) : Frame(v.ns);
  const BsdfSample b = sample(*v.material, v.reflectance, frame.to_local(v.previous), mode, u.u);
  if (!(b.density > 0) || is_black(b.weight)) return;

  const Vec3 next = frame.to_world(b.next);
  const float gn = dot(v.ng, next), sn = b.next.z;
  if (!(gn * sn > 0)) return;
  Rgb factor = b.weight;                                                            // f |cos| / P
  if (mode == TransportMode::Importance) factor *= std::fabs(sp * gn / (gp * sn));  // Veach 5.3.2, shading normals

  // Russian roulette by the local factor (10.3.3). Its probability is no part of the densities in the weights: it
  // depends on the vertex's number, which the other direction cannot know (10.3.6). Refraction changes radiance, not
  // energy: it is not punished.
  if (!survives_roulette(v, gp * gn < 0 ? kMostLikely : norm(b.weight), u[3], factor)) return;
  Interior interior = v.interior;
  if (gp * gn < 0 && !Scene::enter_or_leave(interior, v.material->encloses, gp > 0)) return reject_walk(w);
  v.specular = b.specular;
  walk_on(w, v, next, factor, {b.density / std::fabs(gn), b.density_reverse / std::fabs(gp), std::fabs(gn)}, interior);
}

// The roulette of a vertex, by what it makes of light; the factor of a survivor grows.
bool Block::survives_roulette(const Vertex& v, float local, float u, Rgb& factor) const {
  if (v.count < uint32_t(engine_.options.roulette_start)) return true;
  const float q = std::min(kMostLikely, local);
  if (u >= q) return false;
  factor *= 1 / q;
  return true;
}

void Block::walk_on(const Walker& w, Vertex& v, const Vec3& next, const Rgb& factor, const Leaving& leaving,
                    const Interior& interior) {
  Walker n;
  n.origin = v.p;
  n.normal = v.receiver().normal;
  n.cosine = leaving.cosine;
  n.direction = next;
  n.projected = leaving.projected;
  n.throughput = w.throughput * factor;
  n.density = v.density;
  const float technique = v.specular ? 0 : v.technique;  // by a Dirac, no technique joins this vertex
  n.sums = engine_.heuristic.combine(technique, leaving.reverse * v.sums);
  n.outer =
      !w.eye && engine_.map ? engine_.heuristic.combine(v.count == 2 ? technique : 0, leaving.reverse * v.outer) : 0;
  n.direct = v.direct;
  n.vertex = (w.eye ? eye_.last : light_.last)[w.sample];
  n.count = v.count;
  n.most = w.most;
  n.sample = w.sample;
  n.eye = w.eye;
  n.specular = v.specular;
  n.infinite = false;
  n.start_hittable = w.start_hittable;
  n.start_finite = w.start_finite;
  n.group = w.group;
  n.in_medium = v.in_medium();
  n.interior = interior;
  v.previous_reverse = leaving.reverse * v.geometry;
  push_walker(next_walkers_, next_rays_, n, off_surface(v, next));
}

}  // namespace bdpt
