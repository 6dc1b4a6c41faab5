/* The library inside of a program that has its own job system, its own limit of memory, its own log, and Ctrl-C.
 * `embed_in_host [PASSES]` writes embed_in_host.png, from PASSES samples per pixel (64) and as large as memory allows.
 * The library starts no thread, writes nothing to the terminal, and touches no signal handler. */
#define _POSIX_C_SOURCE 200809L
#include <bdpt.h>
#include <dirent.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

#define WORKERS 3                        /* threads of the job system, beside the one that asks for work */
#define MEMORY_LIMIT (64 * 1024 * 1024u) /* bytes that this program grants */
#define SIZE 1024                        /* pixels that it would like, along each side */

static void check(bdpt_result result) {
  if (result >= 0) return;
  fprintf(stderr, "%s: %s\n", bdpt_result_name(result), bdpt_last_error());
  exit(1);
}

/* --- The host's job system: one job at a time, which all workers and the caller share. --- */

typedef struct job_system {
  pthread_t threads[WORKERS];
  pthread_mutex_t turn, lock; /* of callers; of what follows */
  pthread_cond_t work, done;
  void (*body)(void *body_user, uint32_t i);
  void *body_user;
  uint32_t next, count, running; /* indices [next, count) are not begun */
  uint64_t bodies;
  int quit;
} job_system;

/* Takes indices until none is left; the lock is held before and after, not meanwhile. */
static void help(job_system *j) {
  while (j->next < j->count) {
    const uint32_t i = j->next++;
    ++j->running, ++j->bodies;
    pthread_mutex_unlock(&j->lock);
    j->body(j->body_user, i);
    pthread_mutex_lock(&j->lock);
    if (--j->running == 0 && j->next == j->count) pthread_cond_signal(&j->done);
  }
}

static void *work(void *user) {
  job_system *j = user;
  pthread_mutex_lock(&j->lock);
  while (!j->quit) {
    help(j);
    if (!j->quit) pthread_cond_wait(&j->work, &j->lock);
  }
  pthread_mutex_unlock(&j->lock);
  return NULL;
}

/* bdpt_executor.run */
static void run(void *user, uint32_t n, void (*body)(void *body_user, uint32_t i), void *body_user) {
  job_system *j = user;
  pthread_mutex_lock(&j->turn);
  pthread_mutex_lock(&j->lock);
  j->body = body, j->body_user = body_user, j->next = 0, j->count = n;
  pthread_cond_broadcast(&j->work);
  help(j);
  while (j->running > 0) pthread_cond_wait(&j->done, &j->lock);
  pthread_mutex_unlock(&j->lock);
  pthread_mutex_unlock(&j->turn);
}

static job_system jobs = {.turn = PTHREAD_MUTEX_INITIALIZER, .lock = PTHREAD_MUTEX_INITIALIZER,
                          .work = PTHREAD_COND_INITIALIZER, .done = PTHREAD_COND_INITIALIZER};

static void start(void) {
  for (int i = 0; i < WORKERS; ++i)
    if (pthread_create(&jobs.threads[i], NULL, work, &jobs) != 0) abort();
}

static void stop(void) {
  pthread_mutex_lock(&jobs.lock);
  jobs.quit = 1;
  pthread_cond_broadcast(&jobs.work);
  pthread_mutex_unlock(&jobs.lock);
  for (int i = 0; i < WORKERS; ++i) pthread_join(jobs.threads[i], NULL);
}

/* --- Log, progress, Ctrl-C --- */

static void write_log(void *user, bdpt_log_level level, const char *text) {
  (void)user, fprintf(stderr, "[%s] %s\n", level == BDPT_LOG_WARNING ? "warning" : "info", text);
}

static int count_threads(void) { /* of this process; 0 where there is no /proc */
  int n = 0;
  DIR *folder = opendir("/proc/self/task");
  if (!folder) return 0;
  for (const struct dirent *e; (e = readdir(folder)) != NULL;) n += e->d_name[0] != '.';
  closedir(folder);
  return n;
}

static int most_threads;
static int32_t show_progress(void *user, const bdpt_progress *p) {
  const int threads = count_threads();
  if (threads > most_threads) most_threads = threads;
  (void)user, fprintf(stderr, "\r%3.0f %%", 100 * p->fraction);
  return 0; /* another value would end the call */
}

static bdpt_cancel *cancel; /* bdpt_cancel_request is one atomic store, made for signal handlers */
static void interrupt(int number) { (void)number, bdpt_cancel_request(cancel); }

/* --- The scene: a ball of gold on a floor, in the sun. --- */

static bdpt_scene *build_scene(bdpt_context *context) {
  static const float corners[4][3] = {{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}};
  static const uint16_t triangles[3][3] = {{0, 1, 2}, {0, 2, 3}, {0, 0, 3}}; /* the last has no area: the log tells */
  const bdpt_mesh_desc mesh = {.struct_size = sizeof mesh,
                               .positions = {.data = corners, .count = 4, .format = BDPT_FORMAT_FLOAT3},
                               .indices = {.data = triangles, .count = 3, .format = BDPT_FORMAT_UINT16X3}};
  const bdpt_sphere_desc ball = {.struct_size = sizeof ball, .radius = 0.6f, .center = {0, 0.6f, 0}};
  const bdpt_material_desc grey = {.struct_size = sizeof grey, .reflectance = {0.6f, 0.6f, 0.6f}};
  bdpt_material_desc gold = {.struct_size = sizeof gold, .type = BDPT_MATERIAL_CONDUCTOR, .roughness = {0.1f, 0.1f}};
  check(bdpt_metal_find("Au", gold.eta, gold.k));
  const bdpt_light_desc sky = {.struct_size = sizeof sky, .type = BDPT_LIGHT_ENVIRONMENT, .radiance = {0.2f, 0.3f, 0.5f}};
  const bdpt_light_desc sun = {.struct_size = sizeof sun, .type = BDPT_LIGHT_DIRECTIONAL, .direction = {-1, -1.5f, -1},
                               .irradiance = {3, 2.8f, 2.5f}, .angular_radius = 2};
  bdpt_builder *builder;
  check(bdpt_builder_create(context, &builder));
  bdpt_instance_desc floor = {.struct_size = sizeof floor}, thing = {.struct_size = sizeof thing};
  bdpt_instance_id instance;
  bdpt_light_id light;
  check(bdpt_mesh_add(builder, &mesh, &floor.shape));
  check(bdpt_material_add(builder, &grey, &floor.material));
  check(bdpt_instance_add(builder, &floor, &instance));
  check(bdpt_sphere_add(builder, &ball, &thing.shape));
  check(bdpt_material_add(builder, &gold, &thing.material));
  check(bdpt_instance_add(builder, &thing, &instance));
  check(bdpt_light_add(builder, &sky, &light));
  check(bdpt_light_add(builder, &sun, &light));
  bdpt_scene *scene;
  check(bdpt_scene_build(builder, NULL, &scene));
  bdpt_builder_destroy(builder);
  return scene;
}

int main(int argc, char **argv) {
  start();
  const int threads = most_threads = count_threads();
  const bdpt_executor executor = {.struct_size = sizeof executor, .worker_count = WORKERS + 1, .run = run, .user = &jobs};
  const bdpt_log log = {.struct_size = sizeof log, .write = write_log};
  const bdpt_context_desc host = {
      .struct_size = sizeof host, .executor = &executor, .log = &log, .memory_limit = MEMORY_LIMIT};
  bdpt_context *context;
  check(bdpt_context_create(BDPT_ABI, &host, &context));
  check(bdpt_cancel_create(&cancel));
  struct sigaction action = {.sa_handler = interrupt};
  sigaction(SIGINT, &action, NULL);
  bdpt_scene *scene = build_scene(context);

  /* A film beyond the limit is refused, and nothing has changed: ask for less. */
  bdpt_camera_desc camera = {.struct_size = sizeof camera, .transform = {1, 0, 0, 0, 0, 1, 0, 0.8f, 0, 0, 1, 3.5f}};
  camera.width = camera.height = SIZE;
  bdpt_sensor *sensor;
  bdpt_film *film;
  bdpt_render *render;
  for (;; camera.width /= 2, camera.height /= 2) {
    check(bdpt_camera_create(context, &camera, &sensor));
    bdpt_result result = bdpt_film_create(sensor, NULL, &film);
    if (result == BDPT_OK) result = bdpt_render_create(scene, sensor, film, NULL, &render);
    if (result == BDPT_OK) break;
    if (result != BDPT_ERROR_MEMORY_LIMIT) check(result);
    fprintf(stderr, "%u x %u pixels: %s\n", camera.width, camera.height, bdpt_last_error());
    bdpt_film_release(film), bdpt_sensor_release(sensor);
  }

  const bdpt_advance_desc advance = {.struct_size = sizeof advance, .passes = argc > 1 ? (uint64_t)atoi(argv[1]) : 64,
                                     .cancel = cancel, .progress = show_progress};
  bdpt_advance_report report = {.struct_size = sizeof report};
  const bdpt_result result = bdpt_render_advance(render, &advance, &report);
  check(result);
  bdpt_context_info info = {.struct_size = sizeof info};
  check(bdpt_context_get_info(context, &info));
  printf("\n%s after %llu passes of %u x %u pixels, %llu jobs\n", result == BDPT_CANCELLED ? "cancelled" : "done",
         (unsigned long long)report.passes, camera.width, camera.height, (unsigned long long)jobs.bodies);
  printf("memory: at most %llu of %u bytes\n", (unsigned long long)info.memory_peak, MEMORY_LIMIT);
  printf("threads: %d before, at most %d while rendering\n", threads, most_threads);

  static float pixels[3 * SIZE * SIZE];
  const bdpt_read_desc read = {.struct_size = sizeof read, .include_partial = 1};
  check(bdpt_film_read(film, &read, pixels, sizeof pixels));
  check(bdpt_image_display(NULL, pixels, camera.width, camera.height));
  check(bdpt_image_write_png("embed_in_host.png", pixels, camera.width, camera.height));

  bdpt_render_destroy(render), bdpt_film_release(film), bdpt_sensor_release(sensor), bdpt_scene_release(scene);
  bdpt_cancel_release(cancel), bdpt_context_release(context);
  stop();
  return 0;
}
