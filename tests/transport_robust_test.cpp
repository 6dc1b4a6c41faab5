// Nothing is ever NaN, infinite or negative, and a scene's size is no matter.
#include "rendering.h"

namespace bdpt::transport_robust_test {

using namespace rendering;
using scenes::Builder;

void expect_sane(const ScenePointer& scene, const SensorPointer& camera, const std::string& what) {
  constexpr int kMaxEdges = 6;
  for (Heuristic heuristic : {Heuristic::Power, Heuristic::Maximum, Heuristic::None})
    for (float beta : {2.0f, 3.5f}) {
      if (beta != 2 && heuristic != Heuristic::Power) continue;
      RenderDesc desc;
      desc.transport.max_edges = kMaxEdges;
      desc.transport.heuristic = heuristic;
      desc.transport.beta = beta;
      const Picture p = render(scene, camera, film_desc(camera->width(), camera->height(), kMaxEdges), desc, 24);
      EXPECT_EQ(p.stats.rejected, 0u) << what;
      EXPECT_EQ(p.film->rejected(), 0u) << what;
      for (int k = 1; k <= kMaxEdges; ++k)
        for (int s = 0; s <= k + 1; ++s)
          for (float v : read(*p.film, FilmLayer::Technique, s, k + 1 - s))
            ASSERT_TRUE(v >= 0 && std::isfinite(v)) << what << " (" << s << "," << k + 1 - s << ")";
    }
}

Builder floor_and_walls() {
  Builder b;
  b.add(scenes::box(Vec3(-1), Vec3(1), true), scenes::diffuse(0.6f));
  return b;
}
scenes::MeshData small_quad(const Vec3& center, float side) {
  const float h = side / 2;
  return scenes::quad(center + Vec3(-h, 0, -h), center + Vec3(h, 0, -h), center + Vec3(h, 0, h),
                      center + Vec3(-h, 0, h));
}

void expect_sane(const Builder& builder, const std::string& what) {
  const ScenePointer scene = builder.build();
  scenes::Viewpoint lens = scenes::room_view_through_lens();
  lens.lens_radius = 1e-4f;
  expect_sane(scene, scenes::camera(scenes::room_view(), 24, 24), what + ", pinhole");
  expect_sane(scene, scenes::camera(scenes::room_view_through_lens(), 24, 24), what + ", lens");
  expect_sane(scene, scenes::camera(lens, 24, 24), what + ", tiny lens");
}

TEST(TransportRobust, TinyLights) {
  for (float side : {1e-3f, 1e-5f}) {
    Builder b = floor_and_walls();
    b.add(small_quad(Vec3(0, 0.5f, 0), side), scenes::emitter(Rgb(1 / (side * side))));
    b.add_sphere(Vec3(0.3f, -0.2f, 0), side, scenes::emitter(Rgb(1 / (side * side))));
    expect_sane(b, "light of side " + std::to_string(side));
  }
}

TEST(TransportRobust, LightsThatTouchSurfaces) {
  Builder b = floor_and_walls();
  b.add_sphere(Vec3(0.3f, -0.9f, 0), 0.1f, scenes::emitter(Rgb(2)));
  b.add(scenes::quad(Vec3(-1, -1, -0.9999f), Vec3(1, -1, -0.9999f), Vec3(1, 0, -0.9999f), Vec3(-1, 0, -0.9999f)),
        scenes::emitter(Rgb(1), true, 0.5f));
  b.point(Vec3(0, -0.9999f, 0), Rgb(1));
  b.point(Vec3(-1, 0, 0), Rgb(1));
  b.spot(Vec3(0.5f, 0, 0), Vec3(0, -1, 0), Rgb(1), 0.5, 0);
  expect_sane(b, "touching");
}

TEST(TransportRobust, NearlySmoothSurfaces) {
  for (float alpha : {1e-3f, 1e-4f}) {
    Builder b = floor_and_walls();
    b.add(small_quad(Vec3(0, 0.9f, 0), -0.5f), scenes::emitter(Rgb(2), true));
    b.add_sphere(Vec3(0.4f, -0.6f, 0), 0.4f, scenes::dielectric(1.5f, alpha));
    b.add(scenes::ball(Vec3(-0.4f, -0.6f, 0), 0.4f, 4, true), scenes::conductor(alpha, 0.5f));
    b.add(scenes::box(Vec3(-0.2f, -1, -0.8f), Vec3(0.2f, 0, -0.4f), false), scenes::conductor(alpha, alpha));
    b.point(Vec3(0.1f, 0.2f, 0.3f), Rgb(1));
    b.environment(Rgb(1));
    expect_sane(b, "alpha " + std::to_string(alpha));
  }
}

TEST(TransportRobust, NeedlesAndGrazingLight) {
  Builder b = floor_and_walls();
  scenes::MeshData needles;
  for (int i = 0; i < 50; ++i) {
    const float x = -0.9f + 0.03f * float(i);
    needles.add_quad(Vec3(x, -0.999f, -0.9f), Vec3(x, -0.999f, 0.9f), Vec3(x + 1e-5f, 0.4f, 0.9f),
                     Vec3(x + 1e-5f, 0.4f, -0.9f));
  }
  b.add(needles, scenes::conductor(0.1f, 0.1f));
  b.add(scenes::quad(Vec3(-1, -0.99999f, -1), Vec3(-1, -0.99999f, 1), Vec3(1, -0.99999f, 1), Vec3(1, -0.99999f, -1)),
        scenes::emitter(Rgb(1)));
  b.add(small_quad(Vec3(0, 0.9f, 0), -0.5f), scenes::emitter(Rgb(2), true));
  expect_sane(b, "needles");
}

// The same numbers make the same paths: pictures of scenes of other sizes differ by what rounding turns over.
TEST(TransportRobust, ScaleIsNoMatter) {
  for (const scenes::Contents contents : {scenes::Contents::Diffuse, scenes::Contents::Specular}) {
    const auto measure = [&](float scale) {
      const scenes::RoomOptions room{.contents = contents, .points = true, .environment = true, .scale = scale};
      const ScenePointer scene = scenes::room(room).build();
      const SensorPointer camera = scenes::camera(scenes::room_view_through_lens(), 24, 24, scale);
      Effort effort;
      effort.passes = 2;
      return block_means(scene, camera, options_for({}, 5), effort);
    };
    const BlockMeans expected = measure(1);
    for (float scale : {1e-3f, 1e-1f, 1e4f}) {
      const BlockMeans m = measure(scale);
      EXPECT_EQ(m.rejected, 0u);
      for (size_t i = 0; i < m.values.size(); ++i)
        EXPECT_NEAR(m.values[i].mean(), expected.values[i].mean(), 2e-3 * expected.values[i].mean())
            << "scale " << scale << ", value " << i;
    }
  }
}

}  // namespace bdpt::transport_robust_test
