// Weights: of all techniques of a path they sum to one, and the engine's are those of densities multiplied out here,
// from the scene's own functions, without anything the engine keeps at its vertices.
#include "camera_kinds.h"
#include "rendering.h"
#include "transport/block.h"
#include "transport/correlation.h"
#include "transport/plan.h"
#include "transport/start_pilot.h"

namespace bdpt::transport_weights_test {

using namespace rendering;

constexpr int kSize = 8, kMaxEdges = 6;

// A vertex of a whole path x_0 ... x_k; x_0 on a light, x_k on the lens.
struct Point {
  Vec3 p;
  const Vertex* surface = nullptr;  // x_1 ... x_{k-1}
};

struct Path {
  LightPoint light;
  std::vector<Point> points;
};

float geometry_factor(const Vec3& a, const Vec3* na, const Vec3& b, const Vec3* nb) {
  const Vec3 edge = b - a;
  const float d2 = length_squared(edge);
  const Vec3 w = edge * (1 / std::sqrt(d2));
  return (na ? absdot(*na, w) : 1) * (nb ? absdot(*nb, w) : 1) / d2;
}

// Density per projected solid angle with which the surface samples `to`, coming from `from`.
double scattered(const Vertex& v, const Vec3& from, const Vec3& to, TransportMode mode) {
  const Frame frame = v.material->is_anisotropic() ? Frame(v.ns, v.tangent) : Frame(v.ns);
  const Vec3 previous = unit(from - v.p), next = unit(to - v.p);
  const BsdfValue value = evaluate(*v.material, v.reflectance, frame.to_local(previous), frame.to_local(next), mode);
  return value.density / absdot(v.ng, next);
}

struct Densities {
  std::vector<PathVertex> vertices;
  double direct;
};

Densities densities_of(const Path& path, const Scene& scene, const Engine& engine) {
  const Lights& lights = scene.lights();
  const size_t k = path.points.size() - 1;
  const bool infinite = path.light.infinite;
  const auto at = [&](size_t i) {
    return i == 0 && infinite ? path.points[1].p + path.light.normal : path.points[i].p;
  };
  SensorPoint lens;
  const float any[2] = {0, 0};  // a camera without a lens has no choice
  EXPECT_TRUE(engine.sensor.is_hittable()
                  ? engine.sensor.hit(at(k - 1), unit(at(k) - at(k - 1)), 1e30f, engine.bounds, lens)
                  : engine.sensor.sample_toward(at(k - 1), any, engine.bounds, lens));
  const auto normal = [&](size_t i) {
    return i == 0   ? (path.light.has_area ? &path.light.normal : nullptr)
           : i == k ? &lens.normal
                    : &path.points[i].surface->ng;
  };
  const auto geometry = [&](size_t i) {
    if (i == 0 && infinite) return absdot(path.light.normal, *normal(1));
    return geometry_factor(at(i), normal(i), at(i + 1), normal(i + 1));
  };
  Densities d;
  d.vertices.resize(k + 1);
  for (PathVertex& v : d.vertices) v.specular = false;
  const double position = lights.position_density(path.light, engine.light_choice());
  d.direct = k > 1 ? engine.direct_lighting.density(path.light, path.points[1].surface->receiver()) / position : 1;
  d.vertices[0].light = position;
  d.vertices[1].light = lights.direction_density(path.light, at(1), unit(at(1) - at(0))) * geometry(0);
  for (size_t i = 1; i < k; ++i)
    d.vertices[i + 1].light =
        scattered(*path.points[i].surface, at(i - 1), at(i + 1), TransportMode::Importance) * geometry(i);
  d.vertices[k].eye = lens.density_position;
  d.vertices[k - 1].eye = lens.density_direction * geometry(k - 1);
  for (size_t i = k - 1; i > 0; --i)
    d.vertices[i - 1].eye =
        scattered(*path.points[i].surface, at(i + 1), at(i - 1), TransportMode::Radiance) * geometry(i - 1);
  return d;
}

// All paths of one sample, in the order of techniques.
struct SamplePath {
  int s, t;
  Path path;
};

// The emitters of scenes::room() are told apart by their colour.
int light_of(const Rgb& emission) { return emission.r == 4 ? 0 : emission.r == 1 ? 1 : emission.r == 3 ? 2 : 3; }

// The triangle of one of them that a point is on.
uint32_t primitive_of(int light, const Vec3& p) {
  const scenes::MeshData meshes[] = {
      scenes::quad(Vec3(-0.4f, 0.9f, -0.6f), Vec3(0.4f, 0.9f, -0.6f), Vec3(0.4f, 0.9f, 0.1f), Vec3(-0.4f, 0.9f, 0.1f)),
      scenes::quad(Vec3(-0.8f, -0.2f, -0.9f), Vec3(-0.8f, -0.2f, -0.5f), Vec3(-0.5f, 0.4f, -0.5f),
                   Vec3(-0.5f, 0.4f, -0.9f)),
      {},  // the sphere
      scenes::lantern()};
  const scenes::MeshData& mesh = meshes[light];
  uint32_t best = 0;
  float least = 1e30f;
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const Vec3 a = mesh.positions[t.a], b = mesh.positions[t.b], c = mesh.positions[t.c];
    // Areas of the three triangles with p: their sum is least where p is within.
    const float sum = length(cross(a - p, b - p)) + length(cross(b - p, c - p)) + length(cross(c - p, a - p));
    const float excess = sum - length(cross(b - a, c - a));
    if (excess < least) least = excess, best = i;
  }
  return best;
}

void append(Path& path, const EyeSubpaths& eye, const Vertex& z) {  // z ... z_0, backwards
  const Vertex* v = &z;
  for (; v; v = v->previous_index == kNoVertex ? nullptr : &eye.vertices[v->previous_index])
    path.points.push_back({v->p, v});
  path.points.push_back({eye.starts[0].p});
}

std::vector<SamplePath> paths_of(const Block& block) {
  const EyeSubpaths& eye = block.eye();
  const LightSubpaths& light = block.light();
  const Engine& engine = block.engine();
  std::vector<SamplePath> paths;
  const auto prefix = [&](const Vertex& y) {  // y_0 ... y
    Path path;
    for (const Vertex* v = &y; v; v = v->previous_index == kNoVertex ? nullptr : &light.vertices[v->previous_index])
      path.points.insert(path.points.begin(), {v->p, v});
    path.light = light.starts[0].y0;
    path.points.insert(path.points.begin(), Point{path.light.p});
    return path;
  };
  for (uint32_t i = eye.last[0]; i != kNoVertex; i = eye.vertices[i].previous_index) {
    const Vertex& z = eye.vertices[i];
    if (!is_black(z.material->emission)) {
      Path path;
      const int light = light_of(z.material->emission);
      path.light = {light, primitive_of(light, z.p), {}, false, true, true, z.p, z.ng};
      append(path, eye, z);
      if (z.count > 2) paths.push_back({0, int(z.count), path});
    }
    DirectLight direct;
    const Four u = engine.draw(eye.streams[0], z.count, Purpose::Connect);
    if (engine.direct_lighting.sample(z.receiver(), 0, join(u[0], u[3]), u[1], u[2], direct)) {
      Path path;
      path.light = direct.y0;
      path.points.push_back({direct.y0.p});
      append(path, eye, z);
      paths.push_back({1, int(z.count), path});
    }
    for (uint32_t j = light.last[0]; j != kNoVertex; j = light.vertices[j].previous_index) {
      Path path = prefix(light.vertices[j]);
      append(path, eye, z);
      paths.push_back({int(light.vertices[j].count), int(z.count), path});
    }
  }
  for (uint32_t j = light.last[0]; j != kNoVertex; j = light.vertices[j].previous_index) {
    const Vertex& y = light.vertices[j];
    SensorPoint lens;
    if (!engine.sensor.sample_toward(y.p, engine.draw(light.streams[0], y.count, Purpose::Connect).u, engine.bounds,
                                     lens))
      continue;
    Path path = prefix(y);
    path.points.push_back({lens.p});
    paths.push_back({int(y.count), 1, path});
  }
  return paths;
}

// Renders one sample alone, so that each technique contributes once at most, wherever in the picture.
class OneSample {
 public:
  OneSample(const Scene& scene, const Sensor& sensor, const TransportOptions& options)
      : film_(film_desc(kSize, kSize, kMaxEdges), nullptr), engine_(scene, sensor, film_, options, 7), block_(engine_) {
    if (options.light_start == StartBy::Importance) engine_.starts = pilot_starts(engine_).starts;
  }
  Engine& engine() { return engine_; }
  const Block& block() const { return block_; }
  const Film& film() const { return film_; }

  void run(uint64_t pass) {
    film_.clear();
    const int x = int(pass) % kSize, y = int(pass / kSize) % kSize;
    block_.run(pass, {x, y, x + 1, y + 1});
    film_.end_pass(pass, 0, kSize);
    film_.commit_pass(pass);
  }
  double contribution(int s, int t) const {
    double sum = 0;
    for (float v : read(film_, FilmLayer::Technique, s, t)) sum += v;
    return sum;
  }

 private:
  Film film_;
  Engine engine_;
  Block block_;
};

struct Kind {
  std::string name;
  Heuristic heuristic;
  float beta = 2, cutoff = 0;
};
const std::vector<Kind> kHeuristics = {{"power 2", Heuristic::Power},          {"power 1", Heuristic::Power, 1},
                                       {"power 3.5", Heuristic::Power, 3.5f},  {"balance", Heuristic::Balance},
                                       {"cutoff", Heuristic::Cutoff, 2, 0.1f}, {"maximum", Heuristic::Maximum},
                                       {"average", Heuristic::Average}};

TransportOptions with(TransportOptions options, const Kind& kind) {
  options.heuristic = kind.heuristic;
  options.beta = kind.beta;
  options.cutoff = kind.cutoff;
  return options;
}

void expect_product_weights(const scenes::RoomOptions& room, StartBy light_start, const TechniqueMask& mask,
                            LightSelection selection = LightSelection::Power, int direct_samples = 1,
                            bool correlation_aware = false, SensorPointer camera = nullptr, int at_least = 2000) {
  const ScenePointer scene = scenes::room(room).build();
  if (!camera) camera = scenes::camera(scenes::room_view_through_lens(), kSize, kSize);
  TransportOptions options = options_for(mask, kMaxEdges);
  options.light_start = light_start;
  options.light_selection = selection;
  options.direct_samples = direct_samples;
  options.correlation_aware = correlation_aware;
  if (correlation_aware) options.plan = find_plan("combinatorial");  // many share an eye subpath
  OneSample plain(*scene, *camera, with(options, {"none", Heuristic::None}));
  std::vector<std::unique_ptr<OneSample>> weighted;
  for (const Kind& kind : kHeuristics)
    weighted.push_back(std::make_unique<OneSample>(*scene, *camera, with(options, kind)));
  for (auto& w : weighted) w->engine().starts = plain.engine().starts;  // pilots follow the weights

  int compared = 0;
  for (uint64_t pass = 0; pass < 150; ++pass) {
    plain.run(pass);
    for (auto& w : weighted) w->run(pass);
    for (const SamplePath& p : paths_of(plain.block())) {
      if (p.s + p.t - 1 > kMaxEdges || !mask.allows(p.s, p.t)) continue;
      if (p.s == 1 && p.t > 1 && direct_samples > 1) continue;  // a sum of several paths
      const double whole = plain.contribution(p.s, p.t);
      if (!(whole > 1e-6)) continue;  // occluded, or dark
      const Densities d = densities_of(p.path, *scene, plain.engine());
      PathTechniques techniques{d.vertices.data(), int(d.vertices.size()), d.direct};
      techniques.t0_exists = camera->is_hittable();
      techniques.s0_exists = p.path.light.hittable;
      techniques.corner_exists = !p.path.light.infinite;
      techniques.counts.direct = float(direct_samples);
      if (correlation_aware) techniques.counts.connections = plain.engine().strategy.counts.connections;
      for (size_t i = 0; i < kHeuristics.size(); ++i) {
        const TransportOptions& o = weighted[i]->engine().options;
        const std::string what = kHeuristics[i].name + " (" + std::to_string(p.s) + "," + std::to_string(p.t) + ")";
        double sum = 0;
        for (int s = 0; s <= techniques.count; ++s) sum += reference_weight(techniques, s, o);
        EXPECT_NEAR(sum, 1, 1e-9) << what;
        const double expected = reference_weight(techniques, p.s, o),
                     weight = weighted[i]->contribution(p.s, p.t) / whole;
        // Where weights jump rounding decides.
        if (kHeuristics[i].heuristic == Heuristic::Cutoff || kHeuristics[i].heuristic == Heuristic::Maximum) continue;
        EXPECT_NEAR(weight, expected, 2e-3 * expected + 1e-5) << what << ", pass " << pass;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, at_least);
}

TEST(TransportWeights, AreThoseOfTheProductsOfDensitiesAndSumToOne) {
  expect_product_weights({.points = true}, StartBy::Power, {});
}
TEST(TransportWeights, AreThoseOfTheProductsOfDensitiesWithGlossySurfacesAndUniformLightStart) {
  expect_product_weights({.contents = scenes::Contents::Glossy, .points = true}, StartBy::Uniform, {});
}
TEST(TransportWeights, AreThoseOfTheProductsOfDensitiesWithLightSubpathsStartedByImportance) {
  expect_product_weights({.points = true, .lantern = true}, StartBy::Importance, {});
}
TEST(TransportWeights, AreThoseOfTheProductsOfDensitiesWithTechniquesMasked) {
  expect_product_weights({.points = true}, StartBy::Power, mask_of([](int s, int t) { return s != 1 && t != 0; }));
}

TEST(TransportWeights, AreThoseOfTheProductsOfDensitiesWithATreeOfLights) {
  expect_product_weights({.points = true, .lantern = true}, StartBy::Power, {}, LightSelection::Tree);
}
TEST(TransportWeights, AreThoseOfTheProductsOfDensitiesWithGlossySurfacesAndATreeOfLights) {
  expect_product_weights({.contents = scenes::Contents::Glossy, .points = true, .lantern = true}, StartBy::Uniform, {},
                         LightSelection::Tree);
}

TEST(TransportWeights, AreThoseOfTheProductsOfDensitiesWithLightsAtInfinity) {
  scenes::RoomOptions room{.contents = scenes::Contents::Glossy, .environment = true};
  room.lights = {scenes::environment_map(), scenes::directional(0), scenes::directional(5)};
  // Few light subpaths find the hole in the ceiling.
  expect_product_weights(room, StartBy::Power, {}, LightSelection::Power, 1, false, nullptr, 400);
  expect_product_weights(room, StartBy::Uniform, {}, LightSelection::Tree, 1, false, nullptr, 400);
}

TEST(TransportWeights, AreThoseOfTheProductsOfDensitiesWithPortals) {
  scenes::RoomOptions room{.contents = scenes::Contents::Glossy};
  room.lights = {scenes::environment_map(), scenes::directional(0), scenes::directional(5)};
  for (LightDesc& l : room.lights) l.portals = {scenes::skylight(), scenes::skylight(0.3f)};
  expect_product_weights(room, StartBy::Power, {}, LightSelection::Power, 1, false, nullptr, 1000);
  expect_product_weights(room, StartBy::Uniform, {}, LightSelection::Tree, 1, false, nullptr, 1000);
}

TEST(TransportWeights, AreThoseOfTheProductsOfDensitiesWithSeveralDirectSamples) {
  expect_product_weights({.points = true, .lantern = true}, StartBy::Power, {}, LightSelection::Tree, 3);
}
TEST(TransportWeights, AreThoseOfTheProductsOfDensitiesWithEveryLightInTurn) {
  expect_product_weights({.points = true, .lantern = true}, StartBy::Power, {}, LightSelection::Each, 2);
}

TEST(TransportWeights, AreThoseOfTheProductsOfDensitiesWithCorrelation) {
  expect_product_weights({.points = true}, StartBy::Power, {}, LightSelection::Power, 1, true);
}
TEST(TransportWeights, AreThoseOfTheProductsOfDensitiesWithGlossySurfacesAndCorrelation) {
  expect_product_weights({.contents = scenes::Contents::Glossy, .points = true}, StartBy::Uniform, {},
                         LightSelection::Power, 1, true);
}

// At most kSize x kSize pixels of each.
std::vector<scenes::CameraKind> small_cameras() {
  std::vector<scenes::CameraKind> kinds = scenes::camera_kinds(scenes::room_view());
  for (scenes::CameraKind& kind : kinds) {
    CameraDesc& d = kind.desc;
    if (d.type == CameraType::Cube)
      scenes::crop(d, 40, 0, 48, 8);  // the face ahead
    else
      scenes::crop(d, d.crop[0] + 8, d.crop[1] + 8, d.crop[0] + 16, d.crop[1] + 16);
  }
  return kinds;
}

TEST(TransportWeights, AreThoseOfTheProductsOfDensitiesWithEveryCamera) {
  for (const scenes::CameraKind& kind : small_cameras()) {
    SCOPED_TRACE(kind.name);
    expect_product_weights({.points = true}, StartBy::Power, {}, LightSelection::Power, 1, false,
                           make_camera(kind.desc));
  }
}

// What counts for 100 connections of paths of four edges, by hand: A is 1 here, as the eye's density at x_3 says.
TEST(TransportWeights, OfConnectionsThatShareARareEyeSubpathCountFewer) {
  std::vector<PathVertex> x(5, {1e-3, 1e-3, false});
  x[3].eye = 1.4e-3;
  PathTechniques path{x.data(), 5};
  path.counts.connections = 100;
  const auto counts = [&] {
    std::vector<double> n = {1, 1, 100, 100, 1, 1};
    count_correlated(path, n.data());
    for (size_t i : {0u, 1u, 4u, 5u}) EXPECT_EQ(n[i], 1);
    EXPECT_DOUBLE_EQ(n[3], 100);  // x_3 is seen in each pixel
    return n[2];
  };
  // (2,3) shares x_2, which the eye finds by 1e-3; light finds x_0 and x_1 by 1e-6: light is rarer.
  EXPECT_NEAR(counts(), 100 * 1e-3 / (1e-3 + 1e-6 - 1e-9), 1e-9);
  x[0].light = x[1].light = 10;  // any light subpath comes by
  EXPECT_NEAR(counts(), 1, 1e-12);
  x[1].light = 0.01;
  EXPECT_NEAR(counts(), 100 * 1e-3 / (1e-3 + 0.01 - 1e-5), 1e-9);
  x[3].specular = true;  // there is no choice of x_2
  EXPECT_NEAR(counts(), 100, 1e-12);
}

// Random densities, specular vertices, techniques that do not exist: whatever the path, the weights sum to one.
TEST(TransportWeights, OfRandomDensitiesSumToOne) {
  statistics::Uniform uniform(3);
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<PathVertex> vertices(size_t(2 + int(uniform() * 9)));
    const int k = int(vertices.size()) - 1;
    for (PathVertex& v : vertices) {
      v.light = std::exp(40.0 * uniform() - 20);
      v.eye = std::exp(40.0 * uniform() - 20);
      v.specular = &v != &vertices[0] && &v != &vertices.back() && uniform() < 0.3f;
    }
    PathTechniques path{vertices.data(), k + 1, std::exp(4.0 * uniform() - 2)};
    path.t0_exists = uniform() < 0.5f;
    path.corner_exists = uniform() < 0.8f;
    path.counts = {.light = 1 + 7 * uniform(), .direct = 2, .connections = 0.3f + 20 * uniform()};
    TransportOptions options;
    for (uint32_t& row : options.techniques.rows) row = ~(uniform() < 0.3f ? 1u << int(uniform() * 10) : 0);
    options.techniques.rows[0] = ~0u;  // s = 0 covers every path
    options.correlation_aware = uniform() < 0.5f;
    for (const Kind& kind : kHeuristics) {
      double sum = 0;
      for (int s = 0; s <= k + 1; ++s) sum += reference_weight(path, s, with(options, kind));
      EXPECT_NEAR(sum, 1, 1e-9) << kind.name << ", k = " << k;
    }
    // Shares are sums of the balance heuristic's weights, from wherever the path came.
    options.heuristic = Heuristic::Balance;
    options.correlation_aware = false;
    double eye = 0, light = 0;
    for (int s = 0; s <= k + 1; ++s) {
      const int t = k + 1 - s;
      const double weight = reference_weight(path, s, options);
      if (t <= 1)
        light += weight;
      else if (s <= 1)
        eye += weight;
    }
    const TechniqueShares shares = balance_shares(path, 0, options.techniques);
    EXPECT_NEAR(shares.own, reference_weight(path, 0, options), 1e-6);
    EXPECT_NEAR(shares.eye, eye, 1e-6);
    EXPECT_NEAR(shares.light, light, 1e-6);
  }
}

TEST(TransportWeights, RunningSumsGiveThoseOfThePlainLoop) {
  for (const StartBy light_start : {StartBy::Power, StartBy::Uniform, StartBy::Importance}) {
    scenes::RoomOptions room{.contents = scenes::Contents::Specular, .points = true, .environment = true};
    const ScenePointer scene = scenes::room(room).build();
    std::vector<SensorPointer> cameras = {scenes::camera(scenes::room_view_through_lens(), kSize, kSize)};
    for (const scenes::CameraKind& kind : small_cameras())
      if (light_start == StartBy::Power || kind.desc.type == CameraType::Perspective)
        cameras.push_back(make_camera(kind.desc));
    for (const SensorPointer& camera : cameras) {
      for (const TechniqueMask& mask : {TechniqueMask(), mask_of([](int s, int t) { return s <= 1 || t <= 1; }),
                                        mask_of([](int s, int t) { return s != 1 && (s >= 2 || t >= 2); })})
        for (size_t i = 0; i < 4; ++i) {
          TransportOptions options = with(options_for(mask, kMaxEdges), kHeuristics[i]);
          options.light_start = light_start;
          options.light_samples = i == 1 ? 3 : 1;  // techniques that differ in their number of samples
          options.light_selection = i == 2 ? LightSelection::Tree : LightSelection::Power;
          options.direct_samples = i == 3 ? 2 : 1;
          OneSample fast(*scene, *camera, options), slow(*scene, *camera, options);
          ASSERT_TRUE(fast.engine().running_sums);
          slow.engine().running_sums = false;
          for (uint64_t pass = 0; pass < 24; ++pass) {
            fast.run(pass);
            slow.run(pass);
            for (int k = 1; k <= kMaxEdges; ++k)
              for (int s = 0; s <= k + 1; ++s) {
                const double a = fast.contribution(s, k + 1 - s), b = slow.contribution(s, k + 1 - s);
                EXPECT_NEAR(a, b, 1e-4 * std::fabs(b) + 1e-9)
                    << kHeuristics[i].name << " (" << s << "," << k + 1 - s << "), pass " << pass;
              }
          }
        }
    }
  }
}

}  // namespace bdpt::transport_weights_test
