#include "transport/block.h"

#include "transport/plan.h"

#include <chrono>
#include <limits>

namespace bdpt {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr size_t kConnectionsInFlight = 1024;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Adds the time it lives to a stage.
class StageTimer {
 public:
  explicit StageTimer(double& total) : total_(total), begin_(seconds_now()) {}
  ~StageTimer() { total_ += seconds_now() - begin_; }

 private:
  double& total_;
  double begin_;
};

}  // namespace

void Block::run(uint64_t pass, const BlockRect& rect) {
  start(pass, rect);
  extend();
  const double shadow_before = stats_.shadow, accumulate_before = stats_.accumulate;
  const double begin = seconds_now();
  plan_one_to_one(*this);
  stats_.connect += seconds_now() - begin - (stats_.shadow - shadow_before) - (stats_.accumulate - accumulate_before);
  shadow();
  accumulate();
}

// --- start ---

void Block::start(uint64_t pass, const BlockRect& rect) {
  StageTimer timer(stats_.start);
  const SampleBounds& bounds = engine_.bounds;
  const size_t samples = size_t(rect.x1 - rect.x0) * size_t(rect.y1 - rect.y0);
  pool_.eye.clear();
  pool_.light.clear();
  pool_.eye_starts.resize(samples);
  pool_.light_starts.resize(samples);
  pool_.eye_streams.resize(samples);
  pool_.light_streams.resize(samples);
  pool_.has_light.assign(samples, 0);
  pool_.last_eye.assign(samples, kNoVertex);
  pool_.last_light.assign(samples, kNoVertex);
  eye_sums_.assign(samples, Rgb());
  walkers_.clear();
  rays_.clear();
  uint32_t sample = 0;
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x, ++sample) {
      const uint64_t number = uint64_t(y - bounds.y0) * uint64_t(bounds.width()) + uint64_t(x - bounds.x0);
      start_eye(pass, number, float(x), float(y), sample);
      if (engine_.max_light > 0) start_light(pass, number, sample);
    }
  stats_.samples += samples;
}

void Block::start_eye(uint64_t pass, uint64_t number, float x, float y, uint32_t sample) {
  const Stream stream = pool_.eye_streams[sample] = engine_.eye_stream(pass, number);
  const Four u = engine_.draw_film(stream, pass, number);
  EyeStart& z0 = pool_.eye_starts[sample];
  // Within the pixel, whatever the rounding: x + u may come out as x + 1.
  const auto within = [](float first, float v) { return std::min(first + v, (first + 1) * 0x1.fffffep-1f); };
  z0 = engine_.sensor.start({within(x, u[0]), within(y, u[1])}, u.u + 2, engine_.bounds);
  if (engine_.max_eye < 2) return;
  Walker w{};
  w.eye = true;
  w.origin = z0.p;
  w.cosine = absdot(z0.normal, z0.direction);
  w.direction = z0.direction;
  w.projected = z0.density_direction;
  w.throughput = Rgb(z0.weight);
  w.density = z0.density_position;
  w.sums = engine_.classes.t0 ? 1 : 0;  // u_0: t = 0
  w.vertex = kNoVertex;
  w.count = 1;
  w.sample = sample;
  push_walker(walkers_, rays_, w, z0.p);
}

void Block::start_light(uint64_t pass, uint64_t number, uint32_t sample) {
  const Stream stream = pool_.light_streams[sample] = engine_.light_stream(pass, number);
  const Four u = engine_.draw(stream, 0, Purpose::Start), v = engine_.draw(stream, 0, Purpose::Direction);
  LightStart& y0 = pool_.light_starts[sample];
  if (!engine_.scene.lights().start(u.u, v.u, engine_.options.uniform_light_start, y0)) return;
  pool_.has_light[sample] = 1;
  if (engine_.max_light < 2 || is_black(y0.weight)) return;
  Walker w{};
  w.eye = false;
  w.origin = y0.origin;
  w.infinite = y0.y0.infinite;
  w.cosine = y0.y0.has_area ? absdot(y0.y0.normal, y0.direction) : 1;
  w.direction = y0.direction;
  w.projected = y0.density_direction;
  w.throughput = y0.weight;
  w.density = y0.density_position;
  w.start_hittable = y0.y0.has_area || y0.y0.infinite;
  w.start_finite = !y0.y0.infinite;
  w.sums = engine_.classes.s0 && w.start_hittable ? 1 : 0;  // u_0: s = 0
  w.vertex = kNoVertex;
  w.count = 1;
  w.sample = sample;
  push_walker(walkers_, rays_, w,
              y0.y0.infinite ? y0.origin : off_surface(y0.y0, y0.direction));
}

void Block::push_walker(std::vector<Walker>& walkers, std::vector<Ray>& rays, const Walker& walker, const Vec3& from) {
  walkers.push_back(walker);
  rays.push_back({from, kInfinity, walker.direction});
}

// --- extend ---

void Block::extend() {
  StageTimer timer(stats_.extend);
  while (!walkers_.empty()) {
    trace();
    next_walkers_.clear();
    next_rays_.clear();
    for (size_t i = 0; i < walkers_.size(); ++i) {
      const Walker& w = walkers_[i];
      ++(w.eye ? stats_.eye_rays : stats_.light_rays);
      if (!w.eye && engine_.hit_sensor) hit_sensor(w, rays_[i], hits_[i].instance == kMiss ? kInfinity : hits_[i].t);
      if (hits_[i].instance == kMiss)
        escape(w);
      else
        arrive(w, rays_[i], hits_[i]);
    }
    std::swap(walkers_, next_walkers_);
    std::swap(rays_, next_rays_);
  }
}

void Block::trace() {
  StageTimer timer(stats_.extend_rays);
  hits_.resize(rays_.size());
  engine_.scene.rays().intersect(rays_.data(), hits_.data(), rays_.size());
  if (engine_.recorder) engine_.recorder->record(rays_.data(), rays_.size(), false);
}

// u_i of mis.h, for the technique that would join this vertex to the one before it.
float Block::technique(const Walker& w, const Vertex& v) const {
  if (w.specular || v.specular) return 0;
  const TechniqueClasses& c = engine_.classes;
  if (w.count > 1) return c.inner ? 1 : 0;
  if (w.eye) return c.t1 ? 1 : 0;
  return c.s1 ? v.direct : 0;
}

void Block::arrive(const Walker& w, const Ray& ray, const Hit& hit) {
  Surface surface;
  if (!engine_.scene.surface(ray, hit, surface)) return;
  std::vector<Vertex>& vertices = w.eye ? pool_.eye : pool_.light;
  const Vec3 edge = surface.p - w.origin;
  const float cosine = absdot(surface.ng, w.direction);
  const float geometry = w.infinite ? cosine : w.cosine * cosine / length_squared(edge);
  const float density = w.projected * geometry;
  if (!(density > 0) || !std::isfinite(density)) return;

  const uint32_t index = uint32_t(vertices.size());
  Vertex& v = vertices.emplace_back();
  v.p = surface.p;
  v.margin = surface.margin;
  v.density = density;
  v.ng = surface.ng;
  v.geometry = geometry;
  v.ns = surface.ns;
  v.sums = geometry / w.density * w.sums;
  v.previous = -w.direction;
  v.tangent = surface.tangent;
  v.previous_cosine_g = -dot(v.ng, w.direction);
  v.previous_cosine_s = -dot(v.ns, w.direction);
  v.previous_reverse = 0;
  v.throughput = w.throughput;
  v.reflectance = surface.reflectance;
  v.material = surface.material;
  v.previous_index = w.vertex;
  v.previous_density = w.density;
  v.count = w.count + 1;
  v.specular = surface.material->is_specular();
  v.direct = w.direct;
  v.start_hittable = w.start_hittable;
  v.start_finite = w.start_finite;
  if (!w.eye && w.count == 1) {
    const LightStart& y0 = pool_.light_starts[w.sample];
    v.direct = engine_.scene.lights().direct_density(y0.y0, v.p) / y0.density_position;
  }
  v.technique = technique(w, v);
  (w.eye ? pool_.last_eye : pool_.last_light)[w.sample] = index;

  if (w.eye && surface.light >= 0 && engine_.allows(0, v.count)) {
    LightPoint x0;
    x0.light = surface.light;
    x0.has_area = true;
    x0.p = v.p;
    x0.normal = v.ng;
    const Rgb radiance = engine_.scene.lights().radiance(surface.light, v.ng, v.previous);
    if (!is_black(radiance)) hit_light(w, v, x0, radiance);
  }
  if (v.count < (w.eye ? engine_.max_eye : engine_.max_light)) continue_walk(w, v, index);
}

void Block::escape(const Walker& w) {
  const Lights& lights = engine_.scene.lights();
  if (!w.eye || !lights.has_environment() || !engine_.allows(0, w.count + 1)) return;
  LightPoint x0;
  x0.light = lights.environment();
  x0.infinite = true;
  x0.normal = w.direction;
  Vertex z{};
  z.geometry = w.cosine;  // a direction has no area: the edge's factor is the cosine at its other end
  z.density = w.projected * z.geometry;
  z.sums = w.count == 1 ? 0 : z.geometry / w.density * w.sums;  // no (2,0): see hit_sensor
  z.previous = -w.direction;
  z.throughput = w.throughput;
  z.previous_index = w.vertex;
  z.previous_density = w.density;
  z.count = w.count + 1;
  hit_light(w, z, x0, lights.environment_radiance());
}

// s = 0: the eye subpath ends at z = x_0, on a light.
void Block::hit_light(const Walker& w, const Vertex& z, const LightPoint& x0, const Rgb& radiance) {
  const Lights& lights = engine_.scene.lights();
  const bool corner = z.count == 2;
  const float position = lights.position_density(x0, engine_.options.uniform_light_start);
  const float direction = lights.direction_density(x0, z.previous);
  const float direct = corner ? position : lights.direct_density(x0, w.origin);
  float weight = 1;
  if (engine_.running_sums) {
    // u_1 is that of s = 1 here, seen from the eye: P_A^d(x_0) takes the place of P_A(x_0).
    const TechniqueClasses& c = engine_.classes;
    const bool exists = !w.specular && (corner ? c.corner && !x0.infinite : c.s1);
    weight = engine_.heuristic.weight(
        0, engine_.heuristic.combine(exists ? direct : 0, position * direction * z.sums) / z.density);
  } else if (!engine_.unweighted) {
    Edge edge;
    edge.light_at_z = position;
    edge.light_before_z = direction * z.geometry;
    weight =
        path_weight(nullptr, &z, 0, z.count, edge, {}, {}, position > 0 ? direct / position : 0, true, !x0.infinite);
  }
  add_eye(w.sample, 0, z.count, w.throughput * radiance * weight);
}

// t = 0: the light subpath passes through the sensor, which is no surface of the scene; it is counted and goes on.
void Block::hit_sensor(const Walker& w, const Ray& ray, float tmax) {
  // Not straight from a light without a point: its rays need not cover a lens that lies outside of the scene.
  if (w.infinite) return;
  const uint32_t s = w.count + 1;
  if (!engine_.allows(s, 0) || (engine_.options.max_edges > 0 && w.count > uint32_t(engine_.options.max_edges))) return;
  SensorPoint z0;
  if (!engine_.sensor.hit(ray.origin, ray.direction, tmax, engine_.bounds, z0)) return;
  const float cosine = absdot(z0.normal, w.direction);
  const float geometry = w.infinite ? cosine : w.cosine * cosine / length_squared(z0.p - w.origin);
  const float density = w.projected * geometry;
  if (!(density > 0) || !std::isfinite(density)) return;
  const bool corner = w.count == 1;
  float weight = 1;
  if (engine_.running_sums) {
    const TechniqueClasses& c = engine_.classes;
    const bool exists = !w.specular && (corner ? c.corner : c.t1);
    const float sums = geometry / w.density * w.sums;
    weight = engine_.heuristic.weight(
        z0.density_position / density * engine_.heuristic.combine(exists ? 1 : 0, z0.density_direction * sums), 0);
  } else if (!engine_.unweighted) {
    Vertex y{};
    y.density = density;
    y.geometry = geometry;
    y.previous_index = w.vertex;
    y.previous_density = w.density;
    Edge edge;
    edge.eye_at_y = z0.density_position;
    edge.eye_before_y = z0.density_direction * geometry;
    weight = path_weight(&y, nullptr, s, 0, edge, {}, {}, w.direct, w.start_hittable, w.start_finite);
  }
  add_light(z0.film, s, 0, w.throughput * (z0.importance * weight));
}

void Block::continue_walk(const Walker& w, Vertex& v, uint32_t index) {
  const TransportMode mode = w.eye ? TransportMode::Radiance : TransportMode::Importance;
  const Four u = engine_.draw((w.eye ? pool_.eye_streams : pool_.light_streams)[w.sample], v.count, Purpose::Scatter);
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
  if (v.count >= uint32_t(engine_.options.roulette_start)) {
    constexpr float most = 0.95f;
    const float q = gp * gn < 0 ? most : std::min(most, norm(b.weight));
    if (u[3] >= q) return;
    factor *= 1 / q;
  }

  Walker n;
  n.origin = v.p;
  n.cosine = std::fabs(gn);
  n.direction = next;
  n.projected = b.density / std::fabs(gn);
  n.throughput = w.throughput * factor;
  n.density = v.density;
  const float reverse = b.density_reverse / std::fabs(gp);
  n.sums = engine_.heuristic.combine(v.technique, reverse * v.sums);
  n.direct = v.direct;
  n.vertex = index;
  n.count = v.count;
  n.sample = w.sample;
  n.eye = w.eye;
  n.specular = v.specular;
  n.infinite = false;
  n.start_hittable = w.start_hittable;
  n.start_finite = w.start_finite;
  v.previous_reverse = reverse * v.geometry;
  push_walker(next_walkers_, next_rays_, n, off_surface(v, next));
}

// --- shadow and accumulate ---

void Block::flush_if_full() {
  if (shadow_rays_.size() >= kConnectionsInFlight) shadow();
}

void Block::shadow() {
  {
    StageTimer timer(stats_.shadow);
    blocked_.resize(shadow_rays_.size());
    engine_.scene.rays().occluded(shadow_rays_.data(), blocked_.data(), shadow_rays_.size());
    if (engine_.recorder) engine_.recorder->record(shadow_rays_.data(), shadow_rays_.size(), true);
  }
  StageTimer timer(stats_.accumulate);
  stats_.shadow_rays += shadow_rays_.size();
  for (size_t i = 0; i < connections_.size(); ++i) {
    const Connection& c = connections_[i];
    if (blocked_[i])
      ++stats_.shadow_rays_blocked;
    else if (c.t >= 2)
      add_eye(c.sample, c.s, c.t, c.contribution);
    else
      add_light(c.film, c.s, c.t, c.contribution);
  }
  shadow_rays_.clear();
  connections_.clear();
}

void Block::accumulate() {
  StageTimer timer(stats_.accumulate);
  for (size_t i = 0; i < eye_sums_.size(); ++i) engine_.film.add_eye_sample(pool_.eye_starts[i].film, eye_sums_[i]);
}

void Block::add_eye(uint32_t sample, uint32_t s, uint32_t t, const Rgb& value) {
  if (!is_finite(value)) {
    ++stats_.rejected;
    return;
  }
  eye_sums_[sample] += value;
  if (engine_.film.desc().pyramid_edges > 0)
    engine_.film.add_technique_sample(int(s), int(t), pool_.eye_starts[sample].film, value);
}

void Block::add_light(const FilmPosition& film, uint32_t s, uint32_t t, const Rgb& value) {
  if (!is_finite(value)) {
    ++stats_.rejected;
    return;
  }
  engine_.film.add_light_sample(film, value);
  if (engine_.film.desc().pyramid_edges > 0) engine_.film.add_technique_sample(int(s), int(t), film, value);
}

void Block::push_connection(const Ray& ray, const Rgb& contribution, uint32_t sample, uint32_t s, uint32_t t,
                            const FilmPosition& film) {
  shadow_rays_.push_back(ray);
  connections_.push_back({contribution, film, sample, s, t});
}

TransportStats Block::take_stats() {
  const TransportStats s = stats_;
  stats_ = TransportStats{};
  return s;
}

size_t Block::memory() const {
  return (pool_.eye.capacity() + pool_.light.capacity()) * sizeof(Vertex) +
         (walkers_.capacity() + next_walkers_.capacity()) * sizeof(Walker) +
         (rays_.capacity() + next_rays_.capacity() + shadow_rays_.capacity()) * sizeof(Ray) +
         connections_.capacity() * sizeof(Connection) + hits_.capacity() * sizeof(Hit) +
         pool_.samples() * (sizeof(EyeStart) + sizeof(LightStart) + 2 * sizeof(Stream) + sizeof(Rgb) + 9);
}

}  // namespace bdpt
