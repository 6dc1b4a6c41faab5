/* The Cornell box, with a mirror and a glass sphere, and the pyramid of techniques that made the picture.
 *
 *   cornell_box [FOLDER [PASSES [SIZE]]]
 *
 * writes into FOLDER (default: the current one), from PASSES samples per pixel (64), SIZE x SIZE pixels (512):
 *
 *   cornell_box.png          the picture, through the ACES output transform
 *   cornell_box.exr          its linear light, and a layer for each technique, named s1t2 for (s,t) = (1,2)
 *   cornell_box_pyramid.png  the contributions of the techniques, one row for each path length
 *
 * Needs nothing but bdpt.h and C99. Ctrl-C ends it early, with the picture so far.
 */
#include <bdpt.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAX_EDGES 5 /* the pyramid's last row: paths of five edges */

/* Every call that can fail returns a bdpt_result; negative is an error, and bdpt_last_error() tells the rest. */
static void check(bdpt_result result, const char *what) {
  if (result >= 0) return;
  fprintf(stderr, "\ncornell_box: cannot %s: %s: %s\n", what, bdpt_result_name(result), bdpt_last_error());
  exit(1);
}

static void *allocate(size_t bytes) {
  void *memory = calloc(1, bytes);
  if (!memory) {
    fprintf(stderr, "cornell_box: out of memory\n");
    exit(1);
  }
  return memory;
}

/* ---------------------------------------------------------------------------------------------------------------
 * The scene. A room of 2 x 2 x 2, its floor's centre at the origin, open towards +z, where the camera stands. The
 * proportions and colours are those of the classic box, rounded.
 */

static bdpt_material_id add_material(bdpt_builder *builder, const char *label, bdpt_material_type type, float r,
                                     float g, float b) {
  /* What a descriptor leaves out is zero, and zero is the default. */
  bdpt_material_desc desc = {.struct_size = sizeof desc, .type = type, .label = label, .reflectance = {r, g, b}};
  bdpt_material_id material;
  check(bdpt_material_add(builder, &desc, &material), "add a material");
  return material;
}

static void add_instance(bdpt_builder *builder, bdpt_shape_id shape, bdpt_material_id material, const char *label) {
  bdpt_instance_desc desc = {.struct_size = sizeof desc, .label = label, .shape = shape, .material = material};
  bdpt_instance_id instance;
  check(bdpt_instance_add(builder, &desc, &instance), "add an instance");
}

/* A parallelogram at a corner, spanned by u and v. Its front, which matters for lights, is the side u x v points to. */
static void add_quad(bdpt_builder *builder, bdpt_material_id material, const char *label, const float corner[3],
                     const float u[3], const float v[3]) {
  static const uint32_t triangles[6] = {0, 1, 2, 0, 2, 3};
  float positions[12];
  for (int i = 0; i < 3; ++i) {
    positions[i] = corner[i];
    positions[3 + i] = corner[i] + u[i];
    positions[6 + i] = corner[i] + u[i] + v[i];
    positions[9 + i] = corner[i] + v[i];
  }
  bdpt_mesh_desc desc = {.struct_size = sizeof desc,
                         .label = label,
                         .positions = {.data = positions, .count = 4, .format = BDPT_FORMAT_FLOAT3},
                         .indices = {.data = triangles, .count = 2, .format = BDPT_FORMAT_UINT32X3}};
  bdpt_shape_id shape;
  check(bdpt_mesh_add(builder, &desc, &shape), "add a mesh");
  add_instance(builder, shape, material, label);
}

static void add_sphere(bdpt_builder *builder, bdpt_material_id material, const char *label, float x, float z,
                       float radius) {
  bdpt_sphere_desc desc = {.struct_size = sizeof desc, .label = label, .radius = radius, .center = {x, radius, z}};
  bdpt_shape_id shape;
  check(bdpt_sphere_add(builder, &desc, &shape), "add a sphere");
  add_instance(builder, shape, material, label);
}

static bdpt_scene *build_scene(bdpt_context *context) {
  bdpt_builder *builder;
  check(bdpt_builder_create(context, &builder), "create a builder");

  const bdpt_material_id white = add_material(builder, "white", BDPT_MATERIAL_DIFFUSE, 0.73f, 0.73f, 0.73f);
  const bdpt_material_id red = add_material(builder, "red", BDPT_MATERIAL_DIFFUSE, 0.65f, 0.05f, 0.05f);
  const bdpt_material_id green = add_material(builder, "green", BDPT_MATERIAL_DIFFUSE, 0.12f, 0.45f, 0.15f);
  const bdpt_material_id mirror = add_material(builder, "mirror", BDPT_MATERIAL_MIRROR, 0.95f, 0.95f, 0.95f);
  const bdpt_material_id glass = add_material(builder, "glass", BDPT_MATERIAL_DIELECTRIC, 0, 0, 0);

  add_quad(builder, white, "floor", (float[]){-1, 0, 1}, (float[]){2, 0, 0}, (float[]){0, 0, -2});
  add_quad(builder, white, "ceiling", (float[]){-1, 2, -1}, (float[]){2, 0, 0}, (float[]){0, 0, 2});
  add_quad(builder, white, "back wall", (float[]){-1, 0, -1}, (float[]){2, 0, 0}, (float[]){0, 2, 0});
  add_quad(builder, red, "left wall", (float[]){-1, 0, 1}, (float[]){0, 0, -2}, (float[]){0, 2, 0});
  add_quad(builder, green, "right wall", (float[]){1, 0, -1}, (float[]){0, 0, 2}, (float[]){0, 2, 0});
  add_sphere(builder, mirror, "mirror sphere", -0.43f, -0.4f, 0.42f);
  add_sphere(builder, glass, "glass sphere", 0.42f, 0.3f, 0.36f);

  /* An area light is a shape whose material emits; it hangs just below the ceiling, its front down. */
  bdpt_material_desc light = {.struct_size = sizeof light,
                              .label = "light",
                              .reflectance = {0.78f, 0.78f, 0.78f},
                              .emission = {36, 30, 20}};
  bdpt_material_id light_material;
  check(bdpt_material_add(builder, &light, &light_material), "add the light's material");
  add_quad(builder, light_material, "light", (float[]){-0.24f, 1.995f, -0.2f}, (float[]){0.48f, 0, 0},
           (float[]){0, 0, 0.4f});

  /* The scene keeps what it needs; the builder could go on and build another. */
  bdpt_scene *scene;
  check(bdpt_scene_build(builder, NULL, &scene), "build the scene");
  bdpt_builder_destroy(builder);
  return scene;
}

/* A pinhole camera in front of the open side. It looks along its own -z, so moving it is enough. */
static bdpt_sensor *create_camera(bdpt_context *context, uint32_t size) {
  bdpt_camera_desc desc = {.struct_size = sizeof desc,
                           .width = size,
                           .height = size,
                           .transform = {1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 3.9f},
                           .field_of_view = 38};
  bdpt_sensor *camera;
  check(bdpt_camera_create(context, &desc, &camera), "create the camera");
  return camera;
}

/* ---------------------------------------------------------------------------------------------------------------
 * Rendering, in rounds that double, so that a first picture is there soon.
 */

typedef struct round_info {
  uint64_t done;  /* passes before this round */
  uint64_t total; /* passes wanted in all */
} round_info;

/* Called about ten times a second, on this thread. */
static int32_t show_progress(void *user, const bdpt_progress *progress) {
  const round_info *round = user;
  fprintf(stderr, "\rpass %llu of %llu ", (unsigned long long)(round->done + progress->passes),
          (unsigned long long)round->total);
  return 0; /* go on */
}

static bdpt_cancel *stop;

/* A cancel token may be set from anywhere, even from a signal handler. */
static void on_interrupt(int number) {
  (void)number;
  bdpt_cancel_request(stop);
}

static float *read_layer(const bdpt_film *film, uint32_t size, bdpt_layer layer, uint32_t s, uint32_t t) {
  const size_t bytes = sizeof(float) * 3 * size * size;
  float *pixels = allocate(bytes);
  bdpt_read_desc desc = {.struct_size = sizeof desc, .layer = layer, .s = s, .t = t};
  check(bdpt_film_read(film, &desc, pixels, bytes), "read the film");
  return pixels;
}

/* Linear light to what a display shows, and that into a file. */
static void write_png(const char *path, float *pixels, uint32_t width, uint32_t height, bdpt_view view) {
  bdpt_display_desc display = {.struct_size = sizeof display, .view = view};
  check(bdpt_image_display(&display, pixels, width, height), "apply the display transform");
  check(bdpt_image_write_png(path, pixels, width, height), "write a picture");
}

static void write_picture(const char *path, const bdpt_film *film, uint32_t size) {
  float *pixels = read_layer(film, size, BDPT_LAYER_COLOR, 0, 0);
  write_png(path, pixels, size, size, BDPT_VIEW_ACES);
  free(pixels);
}

static void render_passes(bdpt_scene *scene, bdpt_sensor *camera, bdpt_film *film, uint64_t passes, uint32_t size,
                          const char *path) {
  bdpt_render *render;
  check(bdpt_render_create(scene, camera, film, NULL, &render), "create a render");

  bdpt_result result = BDPT_OK;
  for (round_info round = {0, passes}; round.done < passes && result == BDPT_OK;) {
    bdpt_advance_desc advance = {.struct_size = sizeof advance,
                                 .cancel = stop,
                                 .progress = show_progress,
                                 .progress_user = &round};
    advance.passes = round.done ? round.done : 1; /* twice as many in all */
    if (advance.passes > passes - round.done) advance.passes = passes - round.done;
    bdpt_advance_report report = {.struct_size = sizeof report};
    result = bdpt_render_advance(render, &advance, &report);
    check(result, "render");
    round.done += report.passes;
    fprintf(stderr, "\rpass %llu of %llu", (unsigned long long)round.done, (unsigned long long)passes);
    bdpt_film_info info = {.struct_size = sizeof info};
    check(bdpt_film_get_info(film, &info), "look at the film");
    if (info.relative_error >= 0) fprintf(stderr, ", relative error %.1f %% ", 100 * info.relative_error);
    write_picture(path, film, size);
  }

  bdpt_render_stats stats = {.struct_size = sizeof stats};
  check(bdpt_render_get_stats(render, &stats), "get statistics");
  fprintf(stderr, "%s, %.1f s, %.2f million samples per second\n", result == BDPT_CANCELLED ? ", stopped" : "",
          stats.seconds, stats.seconds > 0 ? 1e-6 * (double)stats.samples / stats.seconds : 0.0);
  bdpt_render_destroy(render);
}

/* ---------------------------------------------------------------------------------------------------------------
 * The pyramid of techniques. A path of k edges can be made in k + 2 ways: s vertices from the light, t from the eye,
 * with s + t - 1 = k. Their weighted contributions add up to the picture; a pinhole cannot be hit, so t = 0 is out.
 */

/* Writes the picture and each technique as layers of one file. */
static void write_layers(const char *path, const bdpt_film *film, uint32_t size) {
  enum { COUNT = 1 + MAX_EDGES * (MAX_EDGES + 3) / 2 };
  static char names[COUNT][8];
  bdpt_image_layer layers[COUNT];
  float *owned[COUNT];
  uint32_t n = 0;
  owned[n++] = read_layer(film, size, BDPT_LAYER_COLOR, 0, 0);
  for (uint32_t k = 1; k <= MAX_EDGES; ++k)
    for (uint32_t s = 0; s <= k; ++s) {
      snprintf(names[n], sizeof names[n], "s%ut%u", (unsigned)s, (unsigned)(k + 1 - s));
      owned[n++] = read_layer(film, size, BDPT_LAYER_TECHNIQUE, s, k + 1 - s);
    }
  for (uint32_t i = 0; i < n; ++i) {
    layers[i].name = names[i]; /* empty for the first: channels R, G, B */
    layers[i].pixels = owned[i];
  }
  bdpt_exr_desc desc = {
      .struct_size = sizeof desc, .width = size, .height = size, .layer_count = n, .layers = layers, .half = 1};
  check(bdpt_image_write_exr(path, &desc), "write the layers");
  for (uint32_t i = 0; i < n; ++i) free(owned[i]);
}

/* Copies an image into a sheet at column x and row y, made smaller by averaging and brighter by so many stops. */
static void paste(float *sheet, uint32_t sheet_width, uint32_t x, uint32_t y, const float *image, uint32_t size,
                  uint32_t shrink, int stops) {
  const float scale = ldexpf(1, stops) / (float)(shrink * shrink);
  for (uint32_t j = 0; j < size / shrink; ++j)
    for (uint32_t i = 0; i < size / shrink; ++i)
      for (uint32_t c = 0; c < 3; ++c) {
        float sum = 0;
        for (uint32_t n = 0; n < shrink * shrink; ++n) {
          const size_t row = j * shrink + n / shrink, column = i * shrink + n % shrink;
          sum += image[3 * (row * size + column) + c];
        }
        sheet[3 * ((size_t)(y + j) * sheet_width + x + i) + c] = scale * sum;
      }
}

/* One row for each k, over-exposed by k - 1 stops, as in Veach's figure 10.4; s grows from left to right, from 0. */
static void write_pyramid(const char *path, const bdpt_film *film, uint32_t size) {
  const uint32_t shrink = (size + 159) / 160, tile = size / shrink, gap = 8;
  const uint32_t width = gap + (MAX_EDGES + 1) * (tile + gap), height = gap + MAX_EDGES * (tile + gap);
  float *sheet = allocate(sizeof(float) * 3 * width * height);
  for (size_t i = 0; i < (size_t)3 * width * height; ++i) sheet[i] = 0.2f; /* grey between the images */
  for (uint32_t k = 1; k <= MAX_EDGES; ++k) {
    const uint32_t left = (width - (k + 1) * (tile + gap) + gap) / 2;
    for (uint32_t s = 0; s <= k; ++s) {
      float *image = read_layer(film, size, BDPT_LAYER_TECHNIQUE, s, k + 1 - s);
      paste(sheet, width, left + s * (tile + gap), gap + (k - 1) * (tile + gap), image, size, shrink, (int)k - 1);
      free(image);
    }
  }
  write_png(path, sheet, width, height, BDPT_VIEW_SRGB);
  free(sheet);
}

/* --------------------------------------------------------------------------------------------------------------- */

/* A number from the command line. */
static uint32_t number(const char *text, const char *what, long lowest, long highest) {
  char *end;
  const long value = strtol(text, &end, 10);
  if (*text == '\0' || *end != '\0' || value < lowest || value > highest) {
    fprintf(stderr, "cornell_box: %s is '%s', and must be a number from %ld to %ld\n", what, text, lowest, highest);
    exit(2);
  }
  return (uint32_t)value;
}

static char *join(const char *folder, const char *name) {
  char *path = allocate(strlen(folder) + strlen(name) + 2);
  sprintf(path, "%s/%s", folder, name);
  return path;
}

int main(int argc, char **argv) {
  if (argc > 4) {
    fprintf(stderr, "usage: cornell_box [FOLDER [PASSES [SIZE]]]\n");
    return 2;
  }
  const char *folder = argc > 1 ? argv[1] : ".";
  const uint32_t passes = argc > 2 ? number(argv[2], "PASSES", 1, 1000000) : 64;
  const uint32_t size = argc > 3 ? number(argv[3], "SIZE", 16, 4096) : 512;
  char *picture = join(folder, "cornell_box.png");
  char *layers = join(folder, "cornell_box.exr");
  char *pyramid = join(folder, "cornell_box_pyramid.png");

  bdpt_context *context;
  check(bdpt_context_create(BDPT_ABI, NULL, &context), "create a context");
  check(bdpt_cancel_create(&stop), "create a cancel token");
  signal(SIGINT, on_interrupt);

  bdpt_scene *scene = build_scene(context);
  bdpt_sensor *camera = create_camera(context, size);
  bdpt_film_desc film_desc = {.struct_size = sizeof film_desc, .pyramid_edges = MAX_EDGES};
  bdpt_film *film;
  check(bdpt_film_create(camera, &film_desc, &film), "create a film");

  render_passes(scene, camera, film, passes, size, picture);
  write_layers(layers, film, size);
  write_pyramid(pyramid, film, size);
  printf("%s\n%s\n%s\n", picture, layers, pyramid);

  /* In any order: each keeps alive what it needs. The signal must not find a token that is gone. */
  signal(SIGINT, SIG_DFL);
  bdpt_cancel_release(stop);
  bdpt_film_release(film);
  bdpt_sensor_release(camera);
  bdpt_scene_release(scene);
  bdpt_context_release(context);
  free(picture);
  free(layers);
  free(pyramid);
  return 0;
}
