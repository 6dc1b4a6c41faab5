// No surface shadows itself, whatever its size, its place and the way it came there; margin.h.
#include "rendering.h"

namespace bdpt::transport_margin_test {

using namespace rendering;
using scenes::Builder;
using scenes::Viewpoint;

// A convex white thing under an even sky of radiance 2: no ray that leaves it meets it again, and it shows 2.
void expect_no_self_shadow(const Builder& things, const Viewpoint& view, const std::string& what) {
  Builder b = things;
  b.environment(Rgb(2));
  const ScenePointer scene = b.build();
  const SensorPointer camera = scenes::camera(view, 32, 32);
  RenderDesc desc;
  desc.transport = options_for({}, 2);
  const Picture joined = render(scene, camera, film_desc(32, 32), desc, 16);
  EXPECT_GT(joined.stats.shadow_rays, 4000u) << what;
  EXPECT_EQ(joined.stats.shadow_rays_blocked, 0u) << what;
  desc.transport = options_for(mask_of([](int s, int) { return s == 0; }), 2);
  const Picture hits = render(scene, camera, film_desc(32, 32), desc, 16);
  double least = 2;
  for (float v : read(*hits.film)) least = std::min(least, double(v));
  EXPECT_NEAR(least, 2, 1e-4) << what;
}

// A square with its middle at `at`, its normal tilted against every axis.
scenes::MeshData tilted(const Vec3& at, float half, const Vec3& normal) {
  const Frame f(unit(normal));
  return scenes::quad(at - f.t * half - f.b * half, at + f.t * half - f.b * half, at + f.t * half + f.b * half,
                      at - f.t * half + f.b * half);
}
Viewpoint above(const Vec3& at, const Vec3& normal, float distance) { return {at + unit(normal) * distance, at, 40}; }

const Vec3 kNormals[] = {{0.3f, 0.8f, 0.5f}, {1, 1, 1}, {0.01f, 1, -0.02f}, {-0.9f, 0.1f, 0.3f}};

TEST(TransportMargin, TriangleOfAnySizeAnywhere) {
  for (const Vec3& n : kNormals)
    for (float half : {1e-3f, 1.0f, 100.0f, 1e4f})
      for (float away : {0.0f, 1.0f, 1e3f}) {
        const Vec3 at = Vec3(0.6f, -0.3f, 0.7f) * away;
        for (float near : {1e-2f, 1.0f}) {
          Builder b;
          b.add(tilted(at, half, n), scenes::diffuse(1));
          std::ostringstream what;
          what << "half " << half << ", away " << away << ", near " << near << ", normal " << n.x;
          // A camera nearer than a thousandth of the triangle's distance sees mostly its own rounding.
          if (half * near < 1e-2f * away) continue;
          expect_no_self_shadow(b, above(at, n, half * near), what.str());
        }
      }
}

TEST(TransportMargin, InstancesOfAMesh) {
  const Vec3 n(0.3f, 0.8f, 0.5f);
  for (float half : {1.0f, 100.0f})
    for (float away : {0.0f, 30.0f, 1e3f}) {
      // The object lies far from its own origin; the instance brings it back. A second one makes it shared.
      const Vec3 at = Vec3(0.6f, -0.3f, 0.7f) * away;
      Transform back;
      back.m[3] = -at.x, back.m[7] = -at.y, back.m[11] = -at.z;
      Transform aside = back;
      const Vec3 t = Frame(unit(n)).t * (10 * half);  // in the same plane: neither shadows the other
      aside.m[3] += t.x, aside.m[7] += t.y, aside.m[11] += t.z;
      Builder b;
      b.add(tilted(at, half, n), scenes::diffuse(1), back);
      b.add_instance(0, 0, aside);
      std::ostringstream what;
      what << "half " << half << ", away " << away;
      if (half < 1e-2f * away) continue;
      expect_no_self_shadow(b, above(Vec3(0), n, half), what.str());
    }
}

TEST(TransportMargin, Sphere) {
  for (float radius : {1e-3f, 1.0f, 1e4f})
    for (float away : {0.0f, 1.0f, 50.0f}) {
      const Vec3 n(0.3f, 0.8f, 0.5f), center = Vec3(0.6f, -0.3f, 0.7f) * (away * radius);
      Builder b;
      b.add_sphere(center, radius, scenes::diffuse(1));
      std::ostringstream what;
      what << "radius " << radius << ", away " << away;
      expect_no_self_shadow(b, {center + unit(n) * (2 * radius), center, 30}, what.str());
    }
}

}  // namespace bdpt::transport_margin_test
