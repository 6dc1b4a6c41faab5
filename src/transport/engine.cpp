#include "transport/engine.h"

#include "transport/plan.h"

namespace bdpt {

namespace {
constexpr uint32_t kUnlimited = 1u << 24;
}

Engine::Engine(const Scene& scene_, const Sensor& sensor_, Film& film_, const TransportOptions& options_,
               uint64_t seed_)
    : scene(scene_),
      sensor(sensor_),
      film(film_),
      options(options_),
      direct_lighting(scene_.lights(), options_.light_selection),
      bounds(film_.sample_bounds()),
      seed(seed_),
      plan(options_.plan ? *options_.plan : *kPlans[0]),
      local(sensor_.is_local()),
      heuristic(options_.heuristic == Heuristic::Balance ? 1 : options_.beta) {
  // What cannot be: a sensor that light cannot hit, a scene whose lights cannot be hit.
  for (uint32_t& row : options.techniques.rows)
    row &= ~((sensor.is_hittable() ? 0u : 1u) | (local && !sensor.can_look() ? 2u : 0u));
  if (!scene.lights().any_hittable()) options.techniques.rows[0] = 0;

  pool_passes = plan.passes == 1 ? 1 : options.pool_passes > 0 ? uint64_t(options.pool_passes) : plan.passes;
  if (options.pool_pixels == int(plan.block_size)) options.pool_pixels = 0;
  pool_pixels = options.pool_pixels > 0 ? uint32_t(options.pool_pixels) : plan.block_size;
  if (options.connections == 0) options.connections = plan.default_connections;
  const bool structured = set_counts(1);
  unweighted = options.heuristic == Heuristic::None;
  // Running sums count all inner techniques alike.
  running_sums = structured && !options.correlation_aware &&
                 (options.heuristic == Heuristic::Power || options.heuristic == Heuristic::Balance);
  limit_subpaths();
  moves = scene.moves() || sensor.moves();
  shares_time = moves && (plan.chooses || (plan.connect != connect_own && !plan.chains));
  media = scene.has_interiors();
  if (media && !local) {
    const float lens[2] = {0.5f, 0.5f};
    const float x = 0.5f * float(bounds.x0 + bounds.x1), y = 0.5f * float(bounds.y0 + bounds.y1);
    sensor_interior = scene.interior_at(sensor.start({x, y}, lens, bounds).p);
  }
  if (options.shadow_roulette == Roulette::Fixed) roulette.set_fixed(options.shadow_threshold);
}

// How long subpaths can be, by the techniques that take part.
void Engine::limit_subpaths() {
  const uint32_t k = options.max_edges > 0 ? uint32_t(options.max_edges) : kUnlimited;
  const TechniqueMask& mask = strategy.techniques;
  max_eye = max_light = 0;
  for (uint32_t s = 0; s < 32; ++s)
    for (uint32_t t = 0; t < 32; ++t) {
      if (s + t < 2 || s + t - 1 > k || !mask.allows(int(s), int(t))) continue;
      const bool more = k == kUnlimited;  // 31 stands for all that follow
      if (t >= 2) max_eye = std::max(max_eye, t == 31 ? (more ? kUnlimited : k + 1 - s) : t);
      if (s >= 2 || (t == 1 && !local)) max_light = std::max(max_light, s == 31 ? (more ? kUnlimited : k + 1 - t) : s);
    }
  hit_sensor = false;
  for (uint32_t s = 2; s < 32; ++s) hit_sensor = hit_sensor || mask.allows(int(s), 0);
  land = hit_sensor && sensor.is_surface();
  cross = hit_sensor && sensor.is_volume();
  hit_sensor = hit_sensor && !sensor.is_surface();
  if (scene.lights().empty()) max_eye = max_light = 0;
}

bool Engine::set_counts(double light_vertices) {
  strategy = make_strategy(plan, options, light_vertices);
  return TechniqueClasses::from_mask(strategy.techniques, strategy.counts, strategy.classes);
}

Strategy Engine::make_strategy(const Plan& p, const TransportOptions& counts, double light_vertices) const {
  Strategy result;
  result.plan = &p;
  result.counts = p.counts(counts, light_vertices);
  result.counts.direct = float(options.direct_samples);
  result.counts.local = local;
  result.counts.pass = result.counts.light * float(samples_per_pass());
  result.techniques = options.techniques;
  for (int s = 0; s < 32; ++s)
    for (int t = 0; t < 32; ++t)
      if (!p.serves(s, t) || !(result.counts.of(s, t) > 0)) result.techniques.rows[size_t(s)] &= ~(1u << t);
  TechniqueClasses::from_mask(result.techniques, result.counts, result.classes);
  return result;
}

bool Strategy::joins_inner() const { return classes.inner > 0 || (counts.local && plan->pooled && classes.t1 > 0); }

float Engine::share(const Plan& p) const {
  if (!map) return 0;
  uint64_t pixels = 0;
  for (int row = 0; row < map->tiles.rows(); ++row)
    for (int column = 0; column < map->tiles.columns(); ++column) {
      const PixelRect tile = map->tiles.pixels(column, row);
      if (map->at({float(tile.x0), float(tile.y0)}).plan == &p) pixels += tile.count();
    }
  return float(double(pixels) / double(bounds.count()));
}

void Engine::choose(StrategyMap chosen) {
  map = std::move(chosen);
  options.light_samples = map->light_samples;
  options.connections = std::max(1, map->light_samples);
  // All that any tile does.
  strategy = map->strategies[0];
  for (const Strategy& s : map->strategies) {
    for (size_t row = 0; row < 32; ++row) strategy.techniques.rows[row] |= s.techniques.rows[row];
    strategy.counts.connections = std::max(strategy.counts.connections, s.counts.connections);
  }
  TechniqueClasses::from_mask(strategy.techniques, strategy.counts, strategy.classes);
  limit_subpaths();
}

// Light subpaths come with eye samples, unless a pool has as many in each pass.
void Engine::set_rates(const RegionGrid& grid, const std::vector<RegionMeasure>& eye,
                       const std::vector<RegionMeasure>& all) {
  rates.set(grid, eye, all, seed);
  light_weight = plan.pooled ? 1 : float(1 / rates.mean());
}

float Engine::time_of_pass(uint64_t pass) const {
  const uint64_t begin = hash_values(seed, 9), step = 0x9e3779b97f4a7c15ull;  // the golden ratio's fraction
  return float((begin + pass / pool_passes * step) >> 40) * 0x1p-24f;
}

EyeStart Engine::start_eye(const FilmPosition& film_position, const float lens[2], float time) const {
  EyeStart z0 = sensor.start(film_position, lens, bounds);
  if (!sensor.moves()) return z0;
  const Rigid motion = sensor.motion(time);
  z0.p = motion.point(z0.p);
  z0.normal = motion.vector(z0.normal);
  z0.direction = motion.vector(z0.direction);
  return z0;
}

bool Engine::sample_toward(const Vec3& x, const float lens[2], float time, SensorPoint& z0) const {
  if (!sensor.moves()) return sensor.sample_toward(x, lens, bounds, z0);
  const Rigid motion = sensor.motion(time);
  if (!sensor.sample_toward(motion.back_point(x), lens, bounds, z0)) return false;
  z0.p = motion.point(z0.p);
  z0.normal = motion.vector(z0.normal);
  return true;
}

bool Engine::hit_camera(const Ray& ray, float tmax, SensorPoint& z0) const {
  if (!sensor.moves()) return sensor.hit(ray.origin, ray.direction, tmax, bounds, z0);
  const Rigid motion = sensor.motion(ray.time);
  if (!sensor.hit(motion.back_point(ray.origin), motion.back_vector(ray.direction), tmax, bounds, z0)) return false;
  z0.p = motion.point(z0.p);
  z0.normal = motion.vector(z0.normal);
  return true;
}

uint64_t Engine::measured(const PixelRect& rect) const {
  if (!local) return rect.count();
  uint64_t n = 0;
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) n += sample_number(x, y) >= 0;
  return n;
}

FilmRecipe Engine::recipe() const {
  const uint64_t all = hash_values(sensor.hash(), film.desc().hash(), options.hash());
  return {seed, scene.info().hash, all, samples_per_pass(), pool_passes};
}

PassInGroup Engine::in_group(uint64_t pass) const { return pass_in_group(pass, pool_passes, film.desc().groups); }

Stream Engine::eye_stream(uint64_t pass, uint64_t number) const {
  if (pass >= kPilotPass) return Stream(hash_values(seed, 6, number), uint32_t(pass - kPilotPass));
  const PassInGroup p = in_group(pass);
  return Stream(hash_values(seed, 1, p.group, number, p.index >> 32), uint32_t(p.index));
}

Stream Engine::light_stream(uint64_t pass, uint64_t number) const {
  if (pass >= kPilotPass) {
    const uint64_t index = (pass - kPilotPass) * light_per_pass() + number;
    return Stream(hash_values(seed, 4, index >> 32), uint32_t(index));
  }
  const PassInGroup p = in_group(pass);
  const uint64_t index = p.index * light_per_pass() + number;
  return Stream(hash_values(seed, 2, p.group, index >> 32), uint32_t(index));
}

Four Engine::draw_film(const Stream& stream, uint64_t pass, uint64_t number) const {
  Four u = draw(stream, 0, Purpose::Start);
  if (pass >= kPilotPass) return u;
  if (options.sampler == SamplerType::Stratified) {
    const uint32_t n = uint32_t(options.strata), cells = n * n;
    const PassInGroup p = in_group(pass);
    const uint64_t order = hash_values(seed, 3, p.group, number, p.index / cells);
    const uint32_t cell = permute(uint32_t(p.index % cells), cells, uint32_t(order));
    const uint32_t column = cell % n, row = cell / n;
    u.u[0] = std::min((float(column) + u.u[0]) / float(n), 0x1.fffffep-1f);
    u.u[1] = std::min((float(row) + u.u[1]) / float(n), 0x1.fffffep-1f);
  }
  return u;
}

}  // namespace bdpt
