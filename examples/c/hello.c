/* The smallest picture: a triangle under a light, as hello.png. */
#include <bdpt.h>
#include <stdio.h>
#include <stdlib.h>

#define WIDTH 400
#define HEIGHT 300

static void check(bdpt_result result) {
  if (result == BDPT_OK) return;
  fprintf(stderr, "%s: %s\n", bdpt_result_name(result), bdpt_last_error());
  exit(1);
}

int main(void) {
  static const float corners[9] = {-1, 0, 0, 1, 0, 0, 0, 1.5f, 0};
  static float pixels[3 * WIDTH * HEIGHT];

  bdpt_context *context;
  bdpt_builder *builder;
  check(bdpt_context_create(BDPT_ABI, NULL, &context));
  check(bdpt_builder_create(context, &builder));

  bdpt_mesh_desc mesh = {.struct_size = sizeof mesh,
                         .positions = {.data = corners, .count = 3, .format = BDPT_FORMAT_FLOAT3}};
  bdpt_material_desc material = {.struct_size = sizeof material, .reflectance = {0.8f, 0.5f, 0.2f}};
  bdpt_instance_desc instance = {.struct_size = sizeof instance};
  check(bdpt_mesh_add(builder, &mesh, &instance.shape));
  check(bdpt_material_add(builder, &material, &instance.material));
  bdpt_instance_id instance_id;
  check(bdpt_instance_add(builder, &instance, &instance_id));

  bdpt_light_desc light = {.struct_size = sizeof light, .position = {1, 2, 2}, .intensity = {20, 20, 20}};
  bdpt_light_id light_id;
  check(bdpt_light_add(builder, &light, &light_id));

  bdpt_camera_desc camera = {.struct_size = sizeof camera, .width = WIDTH, .height = HEIGHT,
                             .transform = {1, 0, 0, 0, 0, 1, 0, 0.75f, 0, 0, 1, 3}};
  bdpt_scene *scene;
  bdpt_sensor *sensor;
  bdpt_film *film;
  bdpt_render *render;
  check(bdpt_scene_build(builder, NULL, &scene));
  check(bdpt_camera_create(context, &camera, &sensor));
  check(bdpt_film_create(sensor, NULL, &film));
  check(bdpt_render_create(scene, sensor, film, NULL, &render));

  bdpt_advance_desc advance = {.struct_size = sizeof advance, .passes = 16};
  bdpt_read_desc read = {.struct_size = sizeof read};
  check(bdpt_render_advance(render, &advance, NULL));
  check(bdpt_film_read(film, &read, pixels, sizeof pixels));
  check(bdpt_image_display(NULL, pixels, WIDTH, HEIGHT));
  check(bdpt_image_write_png("hello.png", pixels, WIDTH, HEIGHT));

  bdpt_render_destroy(render), bdpt_film_release(film), bdpt_sensor_release(sensor), bdpt_scene_release(scene);
  bdpt_builder_destroy(builder), bdpt_context_release(context);
  return 0;
}
