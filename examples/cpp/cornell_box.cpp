// A Cornell box by bdpt.hpp, as cornell_box.png: handles that release themselves, errors as exceptions, a progress
// callable. `cornell_box [PASSES]`; the C example of the same name shows more of the library.
#include <bdpt.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

namespace {

using Vec = std::array<float, 3>;

bdpt_material_id add_material(bdpt::Builder& builder, bdpt_material_type type, Vec reflectance, Vec emission = {}) {
  bdpt_material_desc desc{};  // zero is the default of every field, and the size is set by the call
  desc.type = type;
  std::copy(reflectance.begin(), reflectance.end(), desc.reflectance);
  std::copy(emission.begin(), emission.end(), desc.emission);
  return builder.add_material(desc);
}

void place(bdpt::Builder& builder, bdpt_shape_id shape, bdpt_material_id material) {
  bdpt_instance_desc desc{};
  desc.shape = shape;
  desc.material = material;
  builder.add_instance(desc);
}

// A parallelogram whose front is the side that u x v points to.
void add_quad(bdpt::Builder& builder, bdpt_material_id material, Vec corner, Vec u, Vec v) {
  float p[4][3];
  for (size_t i = 0; i < 3; ++i) {
    p[0][i] = corner[i], p[1][i] = corner[i] + u[i];
    p[2][i] = corner[i] + u[i] + v[i], p[3][i] = corner[i] + v[i];
  }
  const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
  bdpt_mesh_desc desc{};
  desc.positions = bdpt::data(p, 4, BDPT_FORMAT_FLOAT3);
  desc.indices = bdpt::data(triangles, 2, BDPT_FORMAT_UINT16X3);
  place(builder, builder.add_mesh(desc), material);
}

void add_sphere(bdpt::Builder& builder, bdpt_material_id material, Vec center, float radius) {
  bdpt_sphere_desc desc{};
  desc.radius = radius;
  std::copy(center.begin(), center.end(), desc.center);
  place(builder, builder.add_sphere(desc), material);
}

bdpt::Scene build_scene(const bdpt::Context& context) {
  bdpt::Builder builder(context);
  const auto white = add_material(builder, BDPT_MATERIAL_DIFFUSE, {0.73f, 0.73f, 0.73f});
  const auto red = add_material(builder, BDPT_MATERIAL_DIFFUSE, {0.65f, 0.05f, 0.05f});
  const auto green = add_material(builder, BDPT_MATERIAL_DIFFUSE, {0.12f, 0.45f, 0.15f});
  add_quad(builder, white, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});  // floor
  add_quad(builder, white, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2});  // ceiling
  add_quad(builder, white, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0});  // back
  add_quad(builder, red, {-1, 0, 1}, {0, 0, -2}, {0, 2, 0});    // left
  add_quad(builder, green, {1, 0, -1}, {0, 0, 2}, {0, 2, 0});   // right
  add_quad(builder, add_material(builder, BDPT_MATERIAL_DIFFUSE, {0.78f, 0.78f, 0.78f}, {36, 30, 20}),
           {-0.24f, 1.995f, -0.2f}, {0.48f, 0, 0}, {0, 0, 0.4f});
  add_sphere(builder, add_material(builder, BDPT_MATERIAL_MIRROR, {0.95f, 0.95f, 0.95f}), {-0.43f, 0.42f, -0.4f},
             0.42f);
  add_sphere(builder, add_material(builder, BDPT_MATERIAL_DIELECTRIC, {}), {0.42f, 0.36f, 0.3f}, 0.36f);
  return builder.build();
}

}  // namespace

int main(int argc, char** argv) try {
  const bdpt::Context context;
  bdpt_camera_desc camera{};
  camera.width = camera.height = 256;
  camera.field_of_view = 38;
  const float transform[12] = {1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 3.9f};
  std::copy(transform, transform + 12, camera.transform);
  const bdpt::Sensor sensor = bdpt::Sensor::camera(context, camera);
  const bdpt::Film film(sensor);
  bdpt::Render render(build_scene(context), sensor, film);

  bdpt_advance_desc advance{};
  advance.passes = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 64;
  render.advance(advance, [](const bdpt_progress& p) { std::fprintf(stderr, "\r%3.0f %%", 100 * p.fraction); });
  std::fprintf(stderr, "\n");

  std::vector<float> pixels = film.read();
  auto display = bdpt::make<bdpt_display_desc>();
  display.view = BDPT_VIEW_ACES;
  bdpt::check(bdpt_image_display(&display, pixels.data(), camera.width, camera.height));
  bdpt::check(bdpt_image_write_png("cornell_box.png", pixels.data(), camera.width, camera.height));
} catch (const bdpt::Error& error) {
  std::fprintf(stderr, "%s: %s\n", error.name(), error.what());
  return 1;
}
