// Textures and instances in transport: turned, scaled and mirrored copies of a mesh, lamps among them, are what the
// same triangles in the world are, for every plan.
#include "rendering.h"
#include "transport/plan.h"

namespace bdpt::transport_instance_test {

using namespace rendering;
using scenes::Builder;
using scenes::MeshData;

constexpr int kSize = 32;

// Columns given; w is where the origin goes.
Transform frame(const Vec3& u, const Vec3& v, const Vec3& n, const Vec3& w) {
  Transform t;
  for (int row = 0; row < 3; ++row)
    t.m[4 * row] = u[row], t.m[4 * row + 1] = v[row], t.m[4 * row + 2] = n[row], t.m[4 * row + 3] = w[row];
  return t;
}

// As a mesh in the world: normals by the cofactors, triangles turned over where the transform mirrors. Normals keep
// their lengths: an instance's are interpolated first and transformed then.
MeshData placed(MeshData data, const Transform& t) {
  const Vec3 a = t.column(0), b = t.column(1), c = t.column(2);
  const Vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const float sign = t.determinant() < 0 ? -1 : 1;
  for (Vec3& p : data.positions) p = t.point(p);
  for (Vec3& n : data.normals) n = (bc * n.x + ca * n.y + ab * n.z) * sign;
  if (sign < 0)
    for (Triangle& triangle : data.triangles) std::swap(triangle.b, triangle.c);
  return data;
}

// A pyramid on a square, its front outside.
MeshData pyramid() {
  MeshData m;
  m.positions = {Vec3(-1, 0, -1), Vec3(1, 0, -1), Vec3(1, 0, 1), Vec3(-1, 0, 1), Vec3(0, 1, 0)};
  m.triangles = {{0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}, {0, 1, 2}, {0, 2, 3}};
  return m;
}

const Transform kLamps[] = {
    frame(Vec3(0.2f, 0, 0), Vec3(0, -0.3f, 0.05f), Vec3(0, 0.02f, 0.15f), Vec3(-0.4f, 0.9f, -0.3f)),
    frame(Vec3(-0.1f, 0.05f, 0), Vec3(0, -0.2f, 0), Vec3(0.03f, 0, 0.1f), Vec3(0.5f, 0.7f, -0.5f)),  // mirrored
};
const Transform kBalls[] = {
    frame(Vec3(0.5f, 0.1f, 0), Vec3(-0.1f, 0.3f, 0), Vec3(0, 0, 0.4f), Vec3(-0.3f, -0.6f, -0.3f)),
    frame(Vec3(0, 0, 0.3f), Vec3(0, 0.5f, 0), Vec3(0.3f, 0, 0.1f), Vec3(0.5f, -0.5f, -0.2f)),  // mirrored
};

Texture checks() {
  std::vector<float> texels;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      for (float v : {0.8f, 0.5f, 0.3f}) texels.push_back((x + y) % 2 ? v : 0.9f - v);
  return scenes::texture(4, 4, 3, texels);
}

ScenePointer build(bool instanced) {
  Builder b;
  const MaterialDesc floor = scenes::textured(scenes::diffuse(1), Slot::Reflectance, b.add_texture(checks()));
  MeshData ground = scenes::box(Vec3(-1), Vec3(1), true, 4);
  ground.uv = {Vec2(0, 0), Vec2(3, 0), Vec2(3, 2), Vec2(0, 2)};
  b.add(ground, floor);
  b.add(scenes::box(Vec3(-1), Vec3(1), true, 1 | 2 | 8 | 16 | 32), scenes::diffuse(0.6f));
  const Material lamp = scenes::emitter(Rgb(6, 5, 4), false, 0.3f), glossy = scenes::conductor(0.4f, 0.4f);
  const auto add_all = [&](const MeshData& mesh, const Material& material, const Transform(&places)[2]) {
    if (!instanced) {
      for (const Transform& t : places) b.add(placed(mesh, t), material);
      return;
    }
    const int number = b.next_shape();
    b.add(mesh, material, places[0]);
    b.add_instance(number, number, places[1]);
  };
  add_all(pyramid(), lamp, kLamps);
  add_all(scenes::ball(Vec3(0), 1, 4, true), glossy, kBalls);
  return b.build();
}

TransportOptions options_of(const Plan* plan, const TechniqueMask& mask) {
  TransportOptions o = options_for(mask, 5);
  o.plan = plan;
  return o;
}

TEST(TransportInstance, IsWhatTheSameTrianglesInTheWorldAre) {
  const ScenePointer world = build(false), instances = build(true);
  const SensorPointer camera = scenes::camera(scenes::room_view(), kSize, kSize);
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  const auto add = [&](const ScenePointer& scene, const Plan* plan, const TechniqueMask& mask, uint64_t passes,
                       const std::string& name) {
    means.push_back(
        block_means(scene, camera, options_of(plan, mask), {.passes = passes, .first_seed = means.size() + 1}));
    names.push_back(name);
  };
  const TechniqueMask path = mask_of([](int s, int t) { return s <= 1 && t >= 2; });
  const TechniqueMask light = mask_of([](int s, int t) { return t == 1 || (s == 0 && t == 2); });
  add(world, plan_at(0), {}, 32, "in the world");
  add(world, plan_at(0), path, 64, "in the world, path tracing");
  add(instances, plan_at(0), {}, 32, "instances");
  add(instances, plan_at(0), path, 64, "instances, path tracing");
  add(instances, plan_at(0), light, 64, "instances, light tracing");
  for (const char* plan : {"two-way", "pooled", "matrix"})
    add(instances, find_plan(plan), {}, 32, std::string("instances, ") + plan);
  expect_all_same(means, names);
}

}  // namespace bdpt::transport_instance_test
