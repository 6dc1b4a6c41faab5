/* A lightmap of a floor and a wall under a glass ball: its caustic, soft shadow and bounced light, as lightmap.exr with
 * one layer for each output, and lightmap.png. Floor and wall share an atlas. */
#include <bdpt.h>
#include <stdio.h>
#include <stdlib.h>

#define SIDE 256 /* texels of the atlas */
#define TEXELS (SIDE * SIDE)

static void check(bdpt_result result) {
  if (result >= 0) return;
  fprintf(stderr, "%s: %s\n", bdpt_result_name(result), bdpt_last_error());
  exit(1);
}

static bdpt_material_id add_material(bdpt_builder *builder, bdpt_material_type type, float grey, float emission) {
  bdpt_material_desc desc = {.struct_size = sizeof desc, .type = type, .reflectance = {grey, grey, grey},
                             .emission = {emission, emission, emission}};
  bdpt_material_id id;
  check(bdpt_material_add(builder, &desc, &id));
  return id;
}

/* A unit square in the xz plane round the origin, whose front looks up; both sets of texture coordinates cover it. */
static bdpt_shape_id add_square(bdpt_builder *builder) {
  static const float corners[4][3] = {{-0.5f, 0, 0.5f}, {0.5f, 0, 0.5f}, {0.5f, 0, -0.5f}, {-0.5f, 0, -0.5f}};
  static const float uv[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
  bdpt_mesh_desc desc = {.struct_size = sizeof desc, .label = "square",
                         .positions = {.data = corners, .count = 4, .format = BDPT_FORMAT_FLOAT3},
                         .indices = {.data = triangles, .count = 2, .format = BDPT_FORMAT_UINT16X3},
                         .uv = {{0}, {.data = uv, .count = 4, .format = BDPT_FORMAT_FLOAT2}}};
  bdpt_shape_id id;
  check(bdpt_mesh_add(builder, &desc, &id));
  return id;
}

static bdpt_instance_id place(bdpt_builder *builder, bdpt_shape_id shape, bdpt_material_id material,
                              const float transform[12]) {
  bdpt_instance_desc desc = {.struct_size = sizeof desc, .shape = shape, .material = material};
  for (int i = 0; i < 12; ++i) desc.transform[i] = transform[i];
  bdpt_instance_id id;
  check(bdpt_instance_add(builder, &desc, &id));
  return id;
}

static int32_t tell(void *user, const bdpt_progress *progress) {
  (void)user;
  fprintf(stderr, "\rbaking: %3.0f %%", 100 * progress->fraction);
  return 0;
}

int main(void) {
  bdpt_context *context;
  bdpt_builder *builder;
  check(bdpt_context_create(BDPT_ABI, NULL, &context));
  check(bdpt_builder_create(context, &builder));

  const bdpt_shape_id square = add_square(builder);
  bdpt_sphere_desc ball = {.struct_size = sizeof ball, .radius = 0.5f, .center = {0, 0.75f, 0}};
  bdpt_shape_id sphere;
  check(bdpt_sphere_add(builder, &ball, &sphere));
  const bdpt_material_id grey = add_material(builder, BDPT_MATERIAL_DIFFUSE, 0.7f, 0),
                         glass = add_material(builder, BDPT_MATERIAL_DIELECTRIC, 0, 0),
                         lamp = add_material(builder, BDPT_MATERIAL_DIFFUSE, 0, 150);
  static const float floor_at[12] = {3, 0, 0, 0, 0, 1, 0, 0, 0, 0, 3, 0};
  static const float wall_at[12] = {3, 0, 0, 0, 0, 0, -3, 1.5f, 0, 1, 0, -1.5f};  /* looks along +z */
  static const float lamp_at[12] = {0.3f, 0, 0, 0.5f, 0, -1, 0, 3, 0, 0, -0.3f, 0.5f}; /* looks down */
  static const float here[12] = {0};
  bdpt_lightmap_instance mapped[2] = {
      /* The floor takes the left half of the atlas, the wall the right, each with a margin. */
      {.struct_size = sizeof mapped[0], .scale = {0.48f, 0.96f}, .offset = {0.01f, 0.02f}},
      {.struct_size = sizeof mapped[1], .scale = {0.48f, 0.96f}, .offset = {0.51f, 0.02f}}};
  mapped[0].instance = place(builder, square, grey, floor_at);
  mapped[1].instance = place(builder, square, grey, wall_at);
  place(builder, sphere, glass, here);
  place(builder, square, lamp, lamp_at);
  bdpt_scene *scene;
  check(bdpt_scene_build(builder, NULL, &scene));

  /* Three outputs of six planes: all light, indirect light, and spherical harmonics for normal maps. */
  const bdpt_output_desc outputs[3] = {
      {.struct_size = sizeof outputs[0], .kind = BDPT_OUTPUT_IRRADIANCE_OVER_PI},
      {.struct_size = sizeof outputs[0], .kind = BDPT_OUTPUT_IRRADIANCE_OVER_PI, .paths = BDPT_LIGHT_PATHS_INDIRECT},
      {.struct_size = sizeof outputs[0], .kind = BDPT_OUTPUT_IRRADIANCE_SH1}};
  static const char *const names[6] = {NULL, "indirect", "sh.00", "sh.1-1", "sh.10", "sh.11"};
  const bdpt_lightmap_desc map = {.struct_size = sizeof map, .width = SIDE, .height = SIDE,
                                  .instances = mapped, .instance_count = 2, .outputs = outputs, .output_count = 3};
  const bdpt_render_desc how = {.struct_size = sizeof how, .max_edges = 6};
  bdpt_sensor *sensor;
  bdpt_film *film;
  bdpt_render *render;
  check(bdpt_lightmap_create(scene, &map, &sensor));
  check(bdpt_film_create(sensor, NULL, &film));
  check(bdpt_render_create(scene, sensor, film, &how, &render));
  const bdpt_advance_desc advance = {.struct_size = sizeof advance, .passes = 32, .progress = tell};
  check(bdpt_render_advance(render, &advance, NULL));
  fprintf(stderr, "\n");

  /* Each plane, its margins filled, is a layer of the file. */
  static float planes[6][3 * TEXELS], coverage[TEXELS];
  static uint8_t covered[TEXELS];
  check(bdpt_lightmap_read_texels(sensor, coverage, NULL, TEXELS));
  bdpt_image_layer layers[6];
  for (uint32_t p = 0; p < 6; ++p) {
    const bdpt_read_desc read = {.struct_size = sizeof read, .plane = p};
    check(bdpt_film_read(film, &read, planes[p], sizeof planes[p]));
    for (int i = 0; i < TEXELS; ++i) covered[i] = coverage[i] > 0;
    const bdpt_lightmap_dilate_desc gutters = {.struct_size = sizeof gutters, .width = SIDE, .height = SIDE, .channels = 3,
                                               .pixels = planes[p], .pixels_capacity = sizeof planes[p],
                                               .mask = covered, .mask_capacity = sizeof covered};
    check(bdpt_lightmap_dilate(&gutters, NULL));
    layers[p].name = names[p], layers[p].pixels = planes[p];
  }
  const bdpt_exr_desc exr = {.struct_size = sizeof exr, .width = SIDE, .height = SIDE, .layers = layers, .layer_count = 6};
  check(bdpt_image_write_exr("lightmap.exr", &exr));
  check(bdpt_image_display(NULL, planes[0], SIDE, SIDE));
  check(bdpt_image_write_png("lightmap.png", planes[0], SIDE, SIDE));

  bdpt_render_destroy(render), bdpt_film_release(film), bdpt_sensor_release(sensor), bdpt_scene_release(scene);
  bdpt_builder_destroy(builder), bdpt_context_release(context);
  return 0;
}
