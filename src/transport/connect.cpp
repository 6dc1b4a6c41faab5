// Connections: one evaluates, one weighs, and hands the shadow ray on. The order is by cost: sides, BSDFs, weight.
#include "transport/block.h"

namespace bdpt {

namespace {

// The ray between two points that were moved off their surfaces.
Ray between(const Vec3& a, const Vec3& b, float time) { return {a, 1, b - a, time}; }

}  // namespace

void Block::connect(const Vertex& y, const Vertex& z, uint32_t sample, float count, const LightSubpaths& light) {
  ++stats_.connections;
  const Vec3 edge = z.p - y.p;
  const float d2 = length_squared(edge);
  if (!(d2 > 0)) return;
  const float distance = std::sqrt(d2);
  const Vec3 w = edge * (1 / distance);
  Scattering at_y, at_z;
  float z_cosine;
  if (!scatter(y, w, TransportMode::Importance, at_y) || !scatter_to_eye(z, sample, -w, distance, at_z, z_cosine))
    return;
  const float geometry = y.cosine(w) * z_cosine / d2;
  Rgb c = y.throughput * at_y.f * (at_z.f * z.throughput) * geometry;  // (10.8)
  if (is_black(c)) return;
  Ray ray = between(off_surface(y, w), off_surface(z, -w), eye_.time(sample));
  Passage passage;
  if (engine_.media) {
    if (!passes(interior_toward(y, w), ray, distance, passage)) return;
    c *= passage.transmittance();
  }
  const float to_z = geometry * passage.density_to(z.in_medium()),
              to_y = geometry * passage.density_back(y.in_medium());

  float weight = 1;
  if (engine_.running_sums) {
    const PowerHeuristic& h = engine_.heuristic;
    const float count = strategy_->counts.connections;
    const bool outer = engine_.uses_outer(*strategy_);  // then z is a sensor's
    const float technique = outer && y.count > 2 ? 0 : y.technique, sums = outer ? y.outer : y.sums;
    weight = h.weight(at_z.next * (to_y / count) / y.density * h.combine(technique, at_y.previous * sums),
                      at_y.next * (to_z / count) / z.density * h.combine(z.technique, at_z.previous * z.sums));
  } else if (!engine_.unweighted) {
    const Edge e{at_y.next * to_z * (z.is_sensor() ? at_z.previous : 1), at_z.previous * z.geometry, at_z.next * to_y,
                 at_y.previous * y.geometry};
    weight =
        path_weight(&y, &z, y.count, z.count, e, {}, {}, y.direct, y.start_hittable, y.start_finite, light, *strategy_);
  }
  c *= weight / count;
  if (is_black(c)) return;
  push_connection(ray, c, sample, y.count, z.count, y.group);
}

bool Block::scatter_to_eye(const Vertex& z, uint32_t sample, const Vec3& w, float distance, Scattering& scattering,
                           float& cosine) const {
  if (!z.is_sensor()) {
    cosine = z.cosine(w);
    return scatter(z, w, TransportMode::Radiance, scattering);
  }
  SensorDirection toward;
  if (!engine_.sensor.look(eye_.starts[sample], w, toward)) return false;
  scattering = {Rgb(toward.importance), toward.density, along_way(eye_.starts[sample], w, distance)};
  cosine = toward.cosine;
  return true;
}

float Block::along_way(const EyeStart& z0, const Vec3& w, float distance) const {
  if (!engine_.cross) return 1;
  if (std::isinf(distance)) {  // rays of a light without a point start on its disk
    distance = engine_.scene.lights().disk_distance(z0.p, w);
    if (!(distance > 0)) return 0;
  }
  return engine_.sensor.chord_density(z0, w, distance);
}

void Block::connect_to_light(const Vertex& z, uint32_t sample) {
  const DirectLighting& lighting = engine_.direct_lighting;
  const Receiver x = z.receiver();
  const uint32_t samples = uint32_t(engine_.options.direct_samples);
  const uint32_t candidates = uint32_t(engine_.options.direct_candidates), strata = samples * candidates;
  const auto numbers = [&](uint32_t i) { return draw_direct(z, sample, i); };
  uint32_t number = 0;
  for (int turn = 0; turn < lighting.turns(); ++turn)
    for (uint32_t i = 0; i < samples; ++i) {
      // Of the candidates one is kept, by its contribution: each as likely as its part of their sum so far.
      DirectLight light, candidate;
      Ray ray;
      Rgb kept;
      float sum = 0;
      double v = 0;
      if (candidates > 1) {
        const Four u = numbers(number++);
        v = join(u[0], u[1]);
      }
      for (uint32_t k = 0; k < candidates; ++k) {
        const Four u = numbers(number++);
        const double choice = (double(k * samples + i) + join(u[0], u[3])) / strata;
        ++stats_.connections;
        if (!lighting.sample(x, turn, choice, u[1], u[2], candidate)) continue;
        Ray way;
        const Rgb c = direct_contribution(z, sample, candidate, way);
        if (is_black(c)) continue;
        sum += norm(c);
        const double q = double(norm(c)) / double(sum);
        if (!(v >= q)) {  // what is not finite is kept: it will be counted
          v /= q;
          kept = c;
          light = candidate;
          ray = way;
        } else {
          v = (v - q) / (1 - q);
        }
      }
      if (!(sum > 0)) continue;
      // Its probability was its part of the sum.
      const Rgb c = strata == 1 ? kept : kept * (sum / (norm(kept) * float(strata)));
      push_connection(ray, c, sample, 1, z.count, engine_.scene.lights().group(light.y0.light));
    }
}

Four Block::draw_direct(const Vertex& z, uint32_t sample, uint32_t number) {
  if (number == 0) return draw(true, sample, z.count, Purpose::Connect);
  return engine_.draw(another(eye_.streams[sample], number), z.count, Purpose::Connect);
}

Rgb Block::direct_throughput(const Vertex& z, uint32_t sample, const DirectLight& light, Scattering& at_z,
                             float& geometry) {
  const LightPoint& y0 = light.y0;
  const Vec3 w = light.direction;
  float z_cosine;
  if (!scatter_to_eye(z, sample, w, y0.infinite ? kInfinity : light.distance, at_z, z_cosine)) return Rgb();
  const float y_cosine = y0.has_area ? absdot(y0.normal, w) : 1;
  geometry = y0.infinite ? z_cosine : z_cosine * y_cosine / (light.distance * light.distance);
  return z.throughput * at_z.f * light.radiance * (geometry / light.density);
}

// By all samples that direct lighting takes there, candidates too, which cost no ray; the same numbers, so that its
// noise is that of the light which is measured with its shadows.
void Block::measure_unshadowed(uint32_t sample) {
  const EyeStart& z0 = eye_.starts[sample];
  if (z0.weight_position == 0) return;
  const Vertex z = sensor_vertex(sample);
  const DirectLighting& lighting = engine_.direct_lighting;
  const Receiver x = z.receiver();
  const uint32_t samples = uint32_t(engine_.options.direct_samples);
  const uint32_t candidates = uint32_t(engine_.options.direct_candidates), strata = samples * candidates;
  uint32_t number = 0;
  for (int turn = 0; turn < lighting.turns(); ++turn)
    for (uint32_t i = 0; i < samples; ++i) {
      if (candidates > 1) ++number;
      for (uint32_t k = 0; k < candidates; ++k) {
        const Four u = draw_direct(z, sample, number++);
        DirectLight light;
        const double choice = (double(k * samples + i) + join(u[0], u[3])) / strata;
        if (!lighting.sample(x, turn, choice, u[1], u[2], light)) continue;
        Scattering at_z;
        float geometry;
        const Rgb c = direct_throughput(z, sample, light, at_z, geometry) * (eye_weights_[sample] / float(strata));
        if (is_black(c)) continue;
        if (!is_finite(c)) {
          reject(z0.film);
          continue;
        }
        const uint32_t group = engine_.scene.lights().group(light.y0.light);
        responses_.each_unshadowed(z0, light.direction, group, [&](size_t plane, float factor) {
          eye_sums_[sample * responses_.planes() + plane] += c * factor;
        });
      }
    }
}

Rgb Block::direct_contribution(const Vertex& z, uint32_t sample, const DirectLight& light, Ray& ray) {
  const Lights& lights = engine_.scene.lights();
  const LightPoint& y0 = light.y0;
  const Vec3 w = light.direction;
  Scattering at_z;
  float geometry = 0;
  Rgb c = direct_throughput(z, sample, light, at_z, geometry);
  if (is_black(c)) return c;
  const Vec3 from = off_surface(z, w);
  const float time = eye_.time(sample);
  ray = y0.infinite ? Ray{from, kInfinity, w, time} : between(from, off_surface(y0, -w), time);
  Passage passage;
  if (engine_.media) {
    if (!passes(interior_toward(z, w), ray, light.distance, passage)) return Rgb();
    c *= passage.transmittance();
  }
  if (engine_.unweighted) return c;
  const float to_y = geometry * passage.density_to(false), to_z = geometry * passage.density_back(z.in_medium());

  const float position = lights.position_density(y0, engine_.light_choice());
  const float direction = lights.direction_density(y0, z.p, -w);
  if (engine_.running_sums) {
    // p_1 is that of direct lighting; all other p_i know y_0 by P_A (10.3.4.2).
    const PowerHeuristic& h = engine_.heuristic;
    const float density = light.density * strategy_->counts.direct;
    const float s0 = y0.hittable ? strategy_->classes.s0 * at_z.next * to_y / density : 0;
    const float others = direction * to_z / z.density * h.combine(z.technique, at_z.previous * z.sums);
    return c * h.weight(s0, others * (position / density));
  }
  Edge e;
  e.light_at_z = direction * to_z * (z.is_sensor() ? at_z.previous : 1);
  e.light_before_z = at_z.previous * z.geometry;
  const PathVertex start{position, at_z.next * to_y, false};
  return c * path_weight(nullptr, &z, 1, z.count, e, start, {}, light.density / position, y0.hittable,
                         engine_.local || !y0.infinite, light_, *strategy_);
}

void Block::connect_to_own_start(const Vertex& y, uint32_t light) {
  const uint32_t n = uint32_t(engine_.options.light_samples), sample = light / n;
  if (eye_.starts[sample].weight_position != 0) connect(y, sensor_vertex(sample), sample, float(n), light_);
}

void Block::connect_to_sensor(const Vertex& y, uint32_t light) {
  ++stats_.connections;
  const Four u = draw(false, light, y.count, Purpose::Connect);
  SensorPoint z0;
  if (!engine_.sample_toward(y.p, u.u, light_.time(light), z0)) return;
  const Strategy& strategy = engine_.strategy_at(z0.film);
  if (!strategy.allows(y.count, 1)) return;
  const Vec3 edge = z0.p - y.p;
  const float d2 = length_squared(edge);
  if (!(d2 > 0)) return;
  const Vec3 w = edge * (1 / std::sqrt(d2));
  Scattering at_y;
  if (!scatter(y, w, TransportMode::Importance, at_y)) return;
  const float geometry = y.cosine(w) * absdot(z0.normal, w) / d2;
  Rgb c = y.throughput * at_y.f * (geometry * z0.importance / z0.density_position);
  if (is_black(c)) return;
  Ray ray = between(off_surface(y, w), z0.p, light_.time(light));
  Passage passage;
  if (engine_.media) {
    if (!passes(interior_toward(y, w), ray, std::sqrt(d2), passage)) return;
    c *= passage.transmittance();
  }
  const float to_z = geometry * passage.density_to(false), to_y = geometry * passage.density_back(y.in_medium());

  float weight = 1;
  if (engine_.running_sums) {
    const PowerHeuristic& h = engine_.heuristic;
    const float count = strategy.counts.light;
    const bool outer = engine_.uses_outer(strategy);
    const float technique = outer && y.count > 2 ? 0 : y.technique, sums = outer ? y.outer : y.sums;
    weight = h.weight(z0.density_direction * (to_y / count) / y.density * h.combine(technique, at_y.previous * sums),
                      strategy.classes.t0 * at_y.next * (to_z / count) / z0.density_position);
  } else if (!engine_.unweighted) {
    Edge e;
    e.eye_at_y = z0.density_direction * to_y;
    e.eye_before_y = at_y.previous * y.geometry;
    const PathVertex end{at_y.next * to_z, z0.density_position, false};
    weight =
        path_weight(&y, nullptr, y.count, 1, e, {}, end, y.direct, y.start_hittable, y.start_finite, light_, strategy);
  }
  c *= weight / strategy.counts.light;
  if (is_black(c)) return;
  push_connection(ray, c, light, y.count, 1, y.group, z0.film);
}

void Block::connect_start_to_sensor(uint32_t light) {
  const LightStart& start = light_.starts[light];
  if (start.y0.light < 0) return;  // a scene without light
  const LightPoint& y0 = start.y0;
  if (y0.infinite) return;  // a light without a point is seen by s = 0 alone
  ++stats_.connections;
  const Four u = draw(false, light, 1, Purpose::Connect);
  SensorPoint z0;
  if (!engine_.sample_toward(y0.p, u.u, light_.time(light), z0)) return;
  const Strategy& strategy = engine_.strategy_at(z0.film);
  if (!strategy.allows(1, 1)) return;
  const Vec3 edge = z0.p - y0.p;
  const float d2 = length_squared(edge);
  if (!(d2 > 0)) return;
  const Vec3 w = edge * (1 / std::sqrt(d2));
  const Lights& lights = engine_.scene.lights();
  const Rgb emitted = lights.emitted(y0, w);
  const float y_cosine = y0.has_area ? absdot(y0.normal, w) : 1;
  const float geometry = y_cosine * absdot(z0.normal, w) / d2;
  Rgb c = emitted * (geometry * z0.importance / (z0.density_position * start.density_position));
  if (is_black(c)) return;
  Ray ray = between(off_surface(y0, w), z0.p, light_.time(light));
  Passage passage;
  if (engine_.media) {
    if (!passes(engine_.scene.interior_of_light(y0.light), ray, std::sqrt(d2), passage)) return;
    c *= passage.transmittance();
  }

  float weight = 1;
  const float light_at_z0 = lights.direction_density(y0, z0.p, w) * geometry * passage.density_to(false);
  const float eye_at_y0 = z0.density_direction * geometry * passage.density_back(false);
  if (engine_.running_sums) {
    const float s0 = y0.hittable ? strategy.classes.s0 * eye_at_y0 / start.density_position : 0;
    const float t0 = strategy.classes.t0 * light_at_z0 / z0.density_position;
    weight = engine_.heuristic.weight(s0 / strategy.counts.light, t0 / strategy.counts.light);
  } else if (!engine_.unweighted) {
    weight = path_weight(nullptr, nullptr, 1, 1, {}, {start.density_position, eye_at_y0, false},
                         {light_at_z0, z0.density_position, false}, 1, y0.hittable, true, light_, strategy);
  }
  c *= weight / strategy.counts.light;
  if (is_black(c)) return;
  push_connection(ray, c, light, 1, 1, lights.group(y0.light), z0.film);
}

float Block::path_weight(const Vertex* y, const Vertex* z, uint32_t s, uint32_t t, const Edge& edge,
                         PathVertex start_light, PathVertex start_eye, double direct, bool s0_exists,
                         bool corner_exists, const LightSubpaths& light_subpaths, const Strategy& strategy) {
  path_.resize(s + t);
  // Each subpath from its end to its start. What the connecting edge decides comes first; the rest was stored when the
  // subpath was made.
  if (s == 1) path_[0] = start_light;
  if (y) {
    double eye = edge.eye_at_y, eye_before = edge.eye_before_y;
    for (uint32_t i = s - 1;; --i) {
      path_[i] = {y->density, eye, i + 1 < s && y->specular};
      eye = eye_before;
      if (y->previous_index == kNoVertex) {
        path_[i - 1] = {y->previous_density, eye, false};
        break;
      }
      y = &light_subpaths.vertices[y->previous_index];
      eye_before = y->previous_reverse;
    }
  }
  const uint32_t k = s + t - 1;
  if (t == 1) path_[k] = start_eye;
  if (z) {
    double light = edge.light_at_z, light_before = edge.light_before_z;
    for (uint32_t i = s;; ++i) {
      path_[i] = {light, z->density, i > s && z->specular};  // what is joined, or emits, does not do so by a Dirac
      light = light_before;
      if (z->count == 1) break;
      if (z->previous_index == kNoVertex) {
        path_[i + 1] = {light, z->previous_density, false};
        break;
      }
      z = &eye_.vertices[z->previous_index];
      light_before = z->previous_reverse;
    }
  }
  PathTechniques path{path_.data(),  int(path_.size()), direct, s0_exists, engine_.sensor.is_hittable(),
                      corner_exists, strategy.counts};
  if (engine_.tells_shares) return (shares_ = balance_shares(path, int(s), strategy.techniques)).own;
  return float(reference_weight(path, int(s), engine_.options, strategy.techniques));
}

}  // namespace bdpt
