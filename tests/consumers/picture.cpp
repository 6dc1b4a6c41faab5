// The same program by bdpt.hpp; and what it throws is caught as what it is.
#include <bdpt.hpp>

#include <cstdio>

int main() try {
  const float corners[4][3] = {{-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}};
  const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
  const bdpt::Context context;
  bdpt::Builder builder(context);
  bdpt_mesh_desc mesh{};
  mesh.positions = bdpt::data(corners, 4, BDPT_FORMAT_FLOAT3);
  mesh.indices = bdpt::data(triangles, 2, BDPT_FORMAT_UINT16X3);
  bdpt_material_desc material{};
  for (float& v : material.reflectance) v = 0.5f;
  bdpt_instance_desc instance{};
  instance.shape = builder.add_mesh(mesh);
  instance.material = builder.add_material(material);
  builder.add_instance(instance);
  bdpt_light_desc light{};
  light.position[1] = 2;
  for (float& v : light.intensity) v = 4;
  builder.add_light(light);
  bdpt_point point{};
  point.normal[1] = 1;
  bdpt_points_desc points{};
  points.count = 1;
  points.points = &point;
  const bdpt::Sensor sensor = bdpt::Sensor::points(context, points);
  const bdpt::Film film(sensor);
  bdpt::Render(builder.build(), sensor, film).advance(16);
  std::printf("irradiance %.4f\n", double(film.read()[1]));  // 4 W/sr from 2 above: 1 W/m²
  try {
    builder.add_sphere({});
    return 1;
  } catch (const bdpt::Error& error) {
    return error.code() == BDPT_ERROR_INVALID_ARGUMENT ? 0 : 2;
  }
} catch (const bdpt::Error& error) {
  std::fprintf(stderr, "%s: %s\n", error.name(), error.what());
  return 1;
}
