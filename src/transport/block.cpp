#include "transport/block.h"

#include "transport/plan.h"
#include "transport/stage_timer.h"

namespace bdpt {

namespace {

constexpr size_t kConnectionsInFlight = 1024;

}  // namespace

Block::Block(const Engine& engine)
    : engine_(engine), strategy_(&engine.strategy), max_edges_(engine.max_edges()), responses_(engine.sensor) {}

void Block::run(uint64_t pass, const PixelRect& rect, const LightPool* pool) {
  pool_ = pool;
  seed_ = hash_values(engine_.seed, 5, pass, rect.x0, rect.y0);
  if (engine_.plan.run) {
    stats_.samples += engine_.pool_passes * rect.count();
    return engine_.plan.run(*this, pass, rect);
  }
  start_pixels(pass, engine_.pool_passes, rect);
  stats_.samples += eye_.count();
  extend();
  join_inner(*strategy_->plan);
  accumulate();
}

void Block::run_light(uint64_t pass, uint64_t first, uint32_t count, LightSubpaths& kept) {
  keeps_ = pass >= kPilotPass;
  kept_.clear();
  {
    StageTimer timer(stats_.start);
    start(0, count);
    if (engine_.moves) share_time(engine_.time_of_pass(pass));
    for (uint32_t i = 0; i < count; ++i) {
      light_.streams[i] = engine_.light_stream(pass, first + i);
      start_light(i, engine_.max_light);
    }
  }
  extend();
  keeps_ = false;
  std::swap(light_, kept);
}

// --- start ---

void Block::start(size_t eyes, size_t lights) {
  eye_.reset(eyes);
  light_.reset(lights);
  eye_sums_.assign(eyes * responses_.planes(), Rgb());
  responses_.reset(eyes);
  eye_weights_.assign(eyes, 1);
  roulette_key_ = ~0ull;
  walkers_.clear();
  rays_.clear();
}

void Block::share_time(float time) {
  eye_.times.assign(eye_.count(), time);
  light_.times.assign(light_.count(), time);
}

void Block::choose_samples(uint64_t pass, uint64_t passes, const PixelRect& rect) {
  const SampleRates& rates = engine_.rates;
  const bool one_each = !rates.are_set() || pass >= kPilotPass;
  const int groups = engine_.film.desc().groups;
  pixel_samples_.clear();
  for (uint64_t p = pass; p < pass + passes; ++p) {
    const PassInGroup in_group = engine_.in_group(p);
    for (int y = rect.y0; y < rect.y1; ++y)
      for (int x = rect.x0; x < rect.x1; ++x) {
        if (engine_.sample_number(x, y) < 0) continue;
        if (one_each) {
          pixel_samples_.push_back({p, x, y});
          continue;
        }
        const SampleRates::Numbers numbers = rates.numbers(in_group, x, y);
        for (uint64_t n = numbers.begin; n < numbers.end; ++n)
          pixel_samples_.push_back({pass_of({in_group.group, n}, engine_.pool_passes, groups), x, y});
      }
  }
}

void Block::start_pixels(uint64_t pass, uint64_t passes, const PixelRect& rect) {
  StageTimer timer(stats_.start);
  choose_samples(pass, passes, rect);
  strategy_ = &engine_.strategy_at({float(rect.x0), float(rect.y0)});
  // Within the pixel, whatever the rounding: x + u may come out as x + 1.
  const auto within = [](float first, float v) { return std::min(first + v, (first + 1) * 0x1.fffffep-1f); };
  const uint32_t lights = engine_.max_light > 0 && !pool_ ? uint32_t(engine_.options.light_samples) : 0;
  // A subpath of one vertex more than the path's edges ends on the other side's first vertex.
  const uint32_t most_eye = max_edges_ < engine_.max_eye ? max_edges_ + 1 : engine_.max_eye,
                 most_light = max_edges_ < engine_.max_light ? max_edges_ + (engine_.hit_sensor || engine_.land)
                                                             : engine_.max_light;
  start(pixel_samples_.size(), pixel_samples_.size() * lights);
  places_.clear();
  const bool in_volumes = engine_.sensor.is_volume();
  if (engine_.moves) share_time(engine_.shares_time ? engine_.time_of_pass(pass) : 0);
  for (uint32_t sample = 0; sample < pixel_samples_.size(); ++sample) {
    const auto& [p, x, y] = pixel_samples_[sample];
    const uint64_t number = engine_.eye_number(x, y);
    const Stream stream = eye_.streams[sample] = engine_.eye_stream(p, number);
    const Four u = engine_.draw_film(stream, p, number);
    if (engine_.moves && !engine_.shares_time) {
      eye_.times[sample] = draw_time(sample);
      for (uint32_t l = 0; l < lights; ++l) light_.times[sample * lights + l] = eye_.times[sample];
    }
    if (engine_.local)
      places_.push_back(
          {x, y, {u[0], u[1], u[2], u[3], in_volumes ? draw(true, sample, 0, Purpose::Direction)[0] : 0}});
    else
      start_eye(sample, engine_.start_eye({within(float(x), u[0]), within(float(y), u[1])}, u.u + 2, eye_.time(sample)),
                most_eye);
    const uint64_t first = uint64_t(engine_.sample_number(x, y)) * lights;
    for (uint32_t l = 0; l < lights; ++l) {
      light_.streams[sample * lights + l] = engine_.light_stream(p, first + l);
      start_light(sample * lights + l, most_light);
    }
    if (pass < kPilotPass) eye_weights_[sample] = float(1 / engine_.rates.rate(x, y));
  }
  if (!engine_.local) return;
  engine_.sensor.start_many(places_.size(), places_.data(), eye_.starts.data());
  for (uint32_t sample = 0; sample < places_.size(); ++sample) start_eye(sample, eye_.starts[sample], most_eye);
}

void Block::start_eye(uint32_t sample, const EyeStart& start, uint32_t most) {
  EyeStart& z0 = eye_.starts[sample] = start;
  if (!std::isfinite(z0.weight)) {  // what a host's measurement started cannot be used
    reject(z0.film);
    z0.weight_position = 0;
    return;
  }
  uint32_t index = kNoVertex;
  if (engine_.local && keeps_vertices()) {
    index = eye_.last[sample] = uint32_t(eye_.vertices.size());
    eye_.vertices.push_back(sensor_vertex(sample));
  }
  if (responses_.sees() || responses_.sees_surfaces()) most = std::max(most, 2u);
  if (most < 2 || (z0.weight == 0 && !engine_.local)) return;
  Walker w{};
  w.eye = true;
  w.origin = z0.p;
  w.normal = z0.normal;
  w.infinite = z0.parallel;
  w.cosine = z0.cosine;
  w.direction = z0.direction;
  w.projected = z0.density_direction;
  w.throughput = Rgb(z0.weight);
  w.density = z0.density_position;
  w.interior = engine_.sensor_interior;
  w.sums = strategy_->classes.t0;  // u_0: t = 0
  w.vertex = index;
  w.count = 1;
  w.most = most;
  w.sample = sample;
  push_walker(walkers_, rays_, w, off_surface(z0.p, z0.normal, z0.margin, z0.direction));
}

Vertex Block::sensor_vertex(uint32_t sample) const {
  const EyeStart& z0 = eye_.starts[sample];
  Vertex z{};
  z.p = z0.p;
  z.density = z0.density_position;
  z.ng = z.ns = z0.normal;
  z.sums = strategy_->classes.t0;  // what scatter_to_eye tells is u_0's part
  z.throughput = Rgb(z0.weight_position);
  z.previous_index = kNoVertex;
  z.joinable = true;
  z.count = 1;
  z.margin = z0.margin;
  return z;
}

void Block::start_light(uint32_t light, uint32_t most) {
  const Four u = draw(false, light, 0, Purpose::Start), v = draw(false, light, 0, Purpose::Direction);
  LightStart& y0 = light_.starts[light];
  if (!engine_.scene.lights().start(u.u, v.u, engine_.light_choice(), y0)) {
    y0.y0.light = -1;
    return;
  }
  if (most < 2 || is_black(y0.weight)) return;
  Walker w{};
  w.eye = false;
  w.origin = y0.origin;
  w.infinite = y0.y0.infinite;
  w.cosine = y0.y0.has_area ? absdot(y0.y0.normal, y0.direction) : 1;
  w.direction = y0.direction;
  w.projected = y0.density_direction;
  w.throughput = y0.weight;
  w.density = y0.density_position;
  w.start_hittable = y0.y0.hittable;
  w.start_finite = !y0.y0.infinite;
  w.group = uint8_t(engine_.scene.lights().group(y0.y0.light));
  w.interior = engine_.scene.interior_of_light(y0.y0.light);
  w.sums = w.outer = w.start_hittable ? engine_.strategy.classes.s0 : 0;  // u_0: s = 0
  w.vertex = kNoVertex;
  w.count = 1;
  w.most = most;
  w.sample = light;
  push_walker(walkers_, rays_, w, y0.y0.infinite ? y0.origin : off_surface(y0.y0, y0.direction));
}

void Block::push_walker(std::vector<Walker>& walkers, std::vector<Ray>& rays, const Walker& walker, const Vec3& from) {
  walkers.push_back(walker);
  rays.push_back(
      {from, kInfinity, walker.direction, (walker.eye ? eye_.time(walker.sample) : light_.time(walker.sample))});
}

// --- plan, shadow and accumulate ---

void Block::join_inner(const Plan& plan) {
  if (!keeps_vertices()) return;
  {
    const OuterStageTimer timer(stats_.connect, stats_);
    roulette_key_ = ~0ull;
    plan.connect(*this);
  }
  shadow();
}

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
    if (engine_.tells_shares) shares_ = connection_shares_[i];
    if (blocked_[i])
      ++stats_.shadow_rays_blocked, ++techniques_.at(c.s, c.t).shadow_rays_blocked;
    else if (!engine_.belongs_to_eye(c.t))
      add_light(c.sample, c.film, c.s, c.t, c.contribution, c.group);
    else if (c.t >= 2 || responses_.is_plain())
      add_eye(c.sample, c.s, c.t, c.contribution, c.group);
    else {  // the ray leaves z_0 if s = 1, else it comes there
      const Vec3 w = unit(shadow_rays_[i].direction) * (c.s == 1 ? 1.0f : -1.0f);
      add_eye(c.sample, c.s, c.t, c.contribution, c.group, &w);
    }
  }
  shadow_rays_.clear();
  connections_.clear();
  connection_shares_.clear();
}

void Block::accumulate() {
  StageTimer timer(stats_.accumulate);
  const size_t planes = responses_.planes();
  for (size_t i = 0; i < eye_weights_.size(); ++i)
    engine_.film.add_eye_sample(eye_.starts[i].film, &eye_sums_[i * planes], eye_weights_[i]);
}

void Block::reject(const FilmPosition& film) {
  ++stats_.rejected;
  if (!keeps_) engine_.film.reject(film);
}

void Block::add_eye(uint32_t sample, uint32_t s, uint32_t t, const Rgb& contribution, uint32_t group, const Vec3* w) {
  if (!is_finite(contribution)) return reject(eye_.starts[sample].film);
  const Rgb value = contribution * eye_weights_[sample];
  count(s, t, value);
  if (keeps_) {
    kept_.push_back({value, eye_.starts[sample].film, sample, s, t, shares_});
    return;
  }
  const EyeStart& z0 = eye_.starts[sample];
  const bool pyramid = engine_.film.desc().pyramid_edges > 0;
  const auto add = [&](size_t plane, float factor) {
    eye_sums_[sample * responses_.planes() + plane] += value * factor;
    if (pyramid && plane == 0) engine_.film.add_technique_sample(int(s), int(t), z0.film, value * factor);
  };
  if (responses_.is_plain())
    add(0, 1);
  else if (w)
    responses_.each(z0, *w, s + t - 1, group, add);
  else
    responses_.each(sample, z0, s + t - 1, group, add);
}

void Block::add_light(uint32_t light, const FilmPosition& film, uint32_t s, uint32_t t, const Rgb& contribution,
                      uint32_t group, const SensorPlace* z0, const Vec3* w) {
  if (!is_finite(contribution)) return reject(film);
  const Rgb value = contribution * engine_.light_weight;
  count(s, t, value);
  if (keeps_) {
    kept_.push_back({value, film, light, s, t, shares_});
    return;
  }
  const bool pyramid = engine_.film.desc().pyramid_edges > 0;
  const auto add = [&](size_t plane, float factor) {
    engine_.film.add_light_sample(film, value * factor, plane);
    if (pyramid && plane == 0) engine_.film.add_technique_sample(int(s), int(t), film, value * factor);
  };
  if (responses_.is_plain())
    add(0, 1);
  else if (!engine_.local)
    responses_.each(s + t - 1, group, add);
  else
    responses_.each(*z0, *w, s + t - 1, group, add);
}

void Block::push_connection(const Ray& ray, const Rgb& contribution, uint32_t sample, uint32_t s, uint32_t t,
                            uint32_t group, const FilmPosition& film) {
  TechniqueStats& technique = techniques_.at(s, t);
  ++technique.contributions;
  Rgb c = contribution;
  if (engine_.roulette.plays() &&
      !survives(c, sample, s, t, engine_.belongs_to_eye(t) ? eye_.starts[sample].film : film)) {
    ++stats_.shadow_rays_skipped, ++technique.shadow_rays_skipped;
    return;
  }
  ++technique.shadow_rays;
  shadow_rays_.push_back(ray);
  connections_.push_back({c, film, sample, s, t, uint8_t(group)});
  if (engine_.tells_shares) connection_shares_.push_back(shares_);
}

bool Block::survives(Rgb& contribution, uint32_t sample, uint32_t s, uint32_t t, const FilmPosition& film) {
  const float q = engine_.roulette.probability(film, contribution);
  if (q == 1) return true;
  // A number for each connection of a vertex.
  const bool eye = engine_.belongs_to_eye(t);
  const uint64_t key = uint64_t(sample) << 32 | uint64_t(eye ? t : s) << 1 | (eye ? 1 : 0);
  roulette_number_ = key == roulette_key_ ? roulette_number_ + 1 : 0;
  roulette_key_ = key;
  const Stream& stream = eye ? eye_.streams[sample] : light_.streams[sample];
  const uint64_t h = hash_values(stream.scramble, stream.index, 8, s, t, roulette_number_);
  if (float(h >> 40) * 0x1p-24f >= q) return false;
  contribution *= 1 / q;
  return true;
}

void Block::count(uint32_t s, uint32_t t, const Rgb& value) {
  const double v = double(norm(value));
  TechniqueStats& technique = techniques_.at(s, t);
  technique.sum += v;
  technique.squares += v * v;
}

TransportStats Block::take_stats() {
  const TransportStats s = stats_;
  stats_ = TransportStats{};
  return s;
}

size_t Block::memory() const {
  return eye_.memory() + light_.memory() + (walkers_.capacity() + next_walkers_.capacity()) * sizeof(Walker) +
         (rays_.capacity() + next_rays_.capacity() + shadow_rays_.capacity()) * sizeof(Ray) +
         connections_.capacity() * sizeof(Connection) + hits_.capacity() * sizeof(Hit) +
         arrivals_.capacity() * sizeof(Arrival) + eye_sums_.capacity() * sizeof(Rgb) +
         eye_weights_.capacity() * sizeof(float) + responses_.memory() + crossings_.capacity() * sizeof(Crossing) +
         pixel_samples_.capacity() * sizeof(PixelSample) + places_.capacity() * sizeof(SamplePlace) +
         kept_.capacity() * sizeof(Contribution) + host_lookups_.memory() + plan_memory_;
}

}  // namespace bdpt
