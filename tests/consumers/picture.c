/* A program of somebody else's, outside of this project: measures the light of a lamp, over a floor. */
#include <bdpt.h>
#include <stdio.h>

int main(void) {
  static const float corners[4][3] = {{-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}};
  static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
  bdpt_mesh_desc mesh = {.struct_size = sizeof mesh,
                         .positions = {.data = corners, .count = 4, .format = BDPT_FORMAT_FLOAT3},
                         .indices = {.data = triangles, .count = 2, .format = BDPT_FORMAT_UINT16X3}};
  bdpt_material_desc material = {.struct_size = sizeof material, .reflectance = {0.5f, 0.5f, 0.5f}};
  bdpt_instance_desc instance = {.struct_size = sizeof instance};
  bdpt_light_desc light = {.struct_size = sizeof light, .position = {0, 2, 0}, .intensity = {4, 4, 4}};
  bdpt_point point = {.position = {0, 0, 0}, .normal = {0, 1, 0}};
  bdpt_points_desc points = {.struct_size = sizeof points, .count = 1, .points = &point};
  bdpt_advance_desc advance = {.struct_size = sizeof advance, .passes = 16};
  bdpt_read_desc read = {.struct_size = sizeof read};
  bdpt_context *context = NULL;
  bdpt_builder *builder = NULL;
  bdpt_scene *scene = NULL;
  bdpt_sensor *sensor = NULL;
  bdpt_film *film = NULL;
  bdpt_render *render = NULL;
  bdpt_instance_id instance_id;
  bdpt_light_id light_id;
  float rgb[3] = {0, 0, 0};
  bdpt_result result = bdpt_context_create(BDPT_ABI, NULL, &context);
  if (!result) result = bdpt_builder_create(context, &builder);
  if (!result) result = bdpt_mesh_add(builder, &mesh, &instance.shape);
  if (!result) result = bdpt_material_add(builder, &material, &instance.material);
  if (!result) result = bdpt_instance_add(builder, &instance, &instance_id);
  if (!result) result = bdpt_light_add(builder, &light, &light_id);
  if (!result) result = bdpt_scene_build(builder, NULL, &scene);
  if (!result) result = bdpt_points_create(context, &points, &sensor);
  if (!result) result = bdpt_film_create(sensor, NULL, &film);
  if (!result) result = bdpt_render_create(scene, sensor, film, NULL, &render);
  if (!result) result = bdpt_render_advance(render, &advance, NULL);
  if (!result) result = bdpt_film_read(film, &read, rgb, sizeof rgb);
  if (result) return fprintf(stderr, "%s: %s\n", bdpt_result_name(result), bdpt_last_error()), 1;
  printf("irradiance %.4f\n", rgb[1]); /* 4 W/sr from 2 above: 1 W/m² */
  bdpt_render_destroy(render), bdpt_film_release(film), bdpt_sensor_release(sensor), bdpt_scene_release(scene);
  bdpt_builder_destroy(builder), bdpt_context_release(context);
  return 0;
}
