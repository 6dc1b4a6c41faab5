/* A measurement that no renderer has: how much light the leaves of a plant take up. A leaf absorbs on both sides, less of
 * what comes in flat, for its cuticle reflects that. Each leaf is one measurement with two planes: the light that falls on
 * it, and the light that it takes up. */
#include <bdpt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define LEAVES 12
#define PI 3.14159265f
#define WIDTH 0.2f
#define LENGTH 0.6f

static void check(bdpt_result result) {
  if (result >= 0) return;
  fprintf(stderr, "%s: %s\n", bdpt_result_name(result), bdpt_last_error());
  exit(1);
}

/* A leaf: its instance, middle, two half axes and normal. */
typedef struct leaf {
  bdpt_instance_id instance;
  float middle[3], along[3], across[3], normal[3];
} leaf;

typedef struct plant {
  leaf leaves[LEAVES];
  int count;
} plant;

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* A point of the leaf, on either side, and a direction by the cosine. W is 1: what is measured is power. */
static int32_t start(void *user, uint32_t n, const uint64_t *measurements, const float (*u)[4],
                     bdpt_measurement_start *starts) {
  const plant *p = user;
  for (uint32_t i = 0; i < n; ++i) {
    const leaf *l = &p->leaves[measurements[i]];
    const float side = u[i][2] < 0.5f ? 1.0f : -1.0f, r2 = u[i][2] < 0.5f ? 2 * u[i][2] : 2 * u[i][2] - 1;
    const float r = sqrtf(r2), phi = 2 * PI * u[i][3], up = sqrtf(1 - r2);
    const float length = sqrtf(dot(l->along, l->along)), width = sqrtf(dot(l->across, l->across));
    bdpt_measurement_start *s = &starts[i];
    for (int c = 0; c < 3; ++c) {
      s->position[c] = l->middle[c] + l->along[c] * (2 * u[i][0] - 1) + l->across[c] * (2 * u[i][1] - 1);
      s->normal[c] = side * l->normal[c];
      s->direction[c] = r * cosf(phi) * l->along[c] / length + r * sinf(phi) * l->across[c] / width + up * s->normal[c];
    }
    s->weight = 2 * WIDTH * LENGTH; /* one over the density: two sides */
    s->density_position = 1 / s->weight;
    s->density_direction = 1 / PI;
    s->offset = 1e-5f;
  }
  return 0;
}

static int32_t density(void *user, uint32_t n, const bdpt_measurement_place *places, float *densities) {
  (void)user, (void)places;
  for (uint32_t i = 0; i < n; ++i) densities[i] = 1 / PI;
  return 0;
}

static float taken_up(float cosine) {
  const float reflected = 0.04f + 0.96f * powf(1 - cosine, 5); /* Schlick (1994) */
  return 0.85f * (1 - reflected);
}

static int32_t respond(void *user, uint32_t n, const bdpt_measurement_place *places, float *responses) {
  (void)user;
  for (uint32_t i = 0; i < n; ++i) {
    responses[2 * i] = 1;
    responses[2 * i + 1] = taken_up(dot(places[i].normal, places[i].direction));
  }
  return 0;
}

/* Light subpaths that land on a leaf count there. */
static int32_t land(void *user, uint32_t n, const bdpt_measurement_landing *landings, bdpt_measurement_landed *landed) {
  const plant *p = user;
  for (uint32_t i = 0; i < n; ++i) {
    landed[i].measurement = BDPT_NO_MEASUREMENT;
    for (int k = 0; k < p->count; ++k) {
      if (p->leaves[k].instance.id != landings[i].instance.id) continue;
      const float side = dot(p->leaves[k].normal, landings[i].direction) > 0 ? 1.0f : -1.0f;
      landed[i].measurement = (uint64_t)k;
      for (int c = 0; c < 3; ++c) landed[i].normal[c] = side * p->leaves[k].normal[c];
      landed[i].weight = 1;
      landed[i].density_position = 1 / (2 * WIDTH * LENGTH);
    }
  }
  return 0;
}

/* Leaf number k of a spiral round a stem. */
static void add_leaf(bdpt_builder *builder, bdpt_shape_id square, bdpt_material_id green, plant *p) {
  leaf *l = &p->leaves[p->count];
  const float turn = 2.39996f * (float)p->count, height = 0.3f + 0.12f * (float)p->count, rise = 0.35f;
  const float out[3] = {cosf(turn) * cosf(rise), sinf(rise), sinf(turn) * cosf(rise)};
  const float side[3] = {-sinf(turn), 0, cosf(turn)};
  const float up[3] = {side[1] * out[2] - side[2] * out[1], side[2] * out[0] - side[0] * out[2],
                       side[0] * out[1] - side[1] * out[0]};
  const float middle[3] = {0.4f * cosf(turn), height, 0.4f * sinf(turn)};
  bdpt_instance_desc desc = {.struct_size = sizeof desc, .shape = square, .material = green};
  for (int c = 0; c < 3; ++c) {
    l->middle[c] = middle[c], l->normal[c] = up[c];
    l->along[c] = out[c] * LENGTH / 2, l->across[c] = side[c] * WIDTH / 2;
    desc.transform[4 * c] = l->along[c], desc.transform[4 * c + 1] = l->normal[c];
    desc.transform[4 * c + 2] = l->across[c], desc.transform[4 * c + 3] = middle[c];
  }
  check(bdpt_instance_add(builder, &desc, &l->instance));
  ++p->count;
}

/* Measures leaves under a uniform sky of radiance 1 for so many passes. */
static void measure(int leaves, uint64_t passes, float *planes[2]) {
  static const float corners[4][3] = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
  static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
  bdpt_context *context;
  bdpt_builder *builder;
  check(bdpt_context_create(BDPT_ABI, NULL, &context));
  check(bdpt_builder_create(context, &builder));
  const bdpt_mesh_desc mesh = {.struct_size = sizeof mesh,
                               .positions = {.data = corners, .count = 4, .format = BDPT_FORMAT_FLOAT3},
                               .indices = {.data = triangles, .count = 2, .format = BDPT_FORMAT_UINT16X3}};
  const bdpt_material_desc leaf_green = {.struct_size = sizeof leaf_green, .reflectance = {0.1f, 0.1f, 0.1f}};
  const bdpt_light_desc sky = {.struct_size = sizeof sky, .type = BDPT_LIGHT_ENVIRONMENT, .radiance = {1, 1, 1}};
  bdpt_shape_id square;
  bdpt_material_id green;
  bdpt_light_id light;
  check(bdpt_mesh_add(builder, &mesh, &square));
  check(bdpt_material_add(builder, &leaf_green, &green));
  check(bdpt_light_add(builder, &sky, &light));
  plant p = {.count = 0};
  while (p.count < leaves) add_leaf(builder, square, green, &p);

  bdpt_scene *scene;
  bdpt_sensor *sensor;
  bdpt_film *film;
  bdpt_render *render;
  const bdpt_custom_desc custom = {.struct_size = sizeof custom, .planes = 2, .measurements = (uint64_t)leaves,
                                   .start = start, .density = density, .respond = respond, .land = land, .user = &p};
  const bdpt_advance_desc advance = {.struct_size = sizeof advance, .passes = passes};
  check(bdpt_scene_build(builder, NULL, &scene));
  check(bdpt_custom_create(context, &custom, &sensor));
  check(bdpt_film_create(sensor, NULL, &film));
  check(bdpt_render_create(scene, sensor, film, NULL, &render));
  check(bdpt_render_advance(render, &advance, NULL));
  for (uint32_t plane = 0; plane < 2; ++plane) {
    float rgb[3 * 16]; /* the film has the leaves in rows: 12 in 4 x 3, one in 1 x 1 */
    const bdpt_read_desc read = {.struct_size = sizeof read, .plane = plane};
    check(bdpt_film_read(film, &read, rgb, sizeof rgb));
    for (int k = 0; k < leaves; ++k) planes[plane][k] = rgb[3 * k];
  }
  bdpt_render_destroy(render), bdpt_film_release(film), bdpt_sensor_release(sensor), bdpt_scene_release(scene);
  bdpt_builder_destroy(builder), bdpt_context_release(context);
}

int main(void) {
  float falls[LEAVES], taken[LEAVES], *planes[2] = {falls, taken};
  measure(1, 4096, planes);
  printf("a leaf alone: %.4f W falls on it, and should: %.4f\n", falls[0], 2 * PI * WIDTH * LENGTH);
  measure(LEAVES, 1024, planes);
  printf("leaf  falls on it [W]  takes up [W]\n");
  for (int k = 0; k < LEAVES; ++k) printf("%4d  %15.4f  %12.4f\n", k, falls[k], taken[k]);
  return 0;
}
