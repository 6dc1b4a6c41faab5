// What the calls themselves cost, beside what they ask for: many calls of one pass against one of many passes, an
// image sent by tiles, contexts and scenes made and given back. Through bdpt.h alone, as a host sees it.
//
// SPDX-License-Identifier: Apache-2.0
#include <bdpt.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <vector>

#include "timing.h"

namespace {

using bdpt_benchmark::clock_seconds;
using bdpt_benchmark::median;

constexpr uint32_t kSide = 256;
constexpr uint64_t kPasses = 8;

void check(bdpt_result result) {
  if (result == BDPT_OK) return;
  std::fprintf(stderr, "%s: %s\n", bdpt_result_name(result), bdpt_last_error());
  std::exit(1);
}

template <class T>
T make() {
  T desc{};
  desc.struct_size = sizeof desc;
  return desc;
}

bdpt_material_id add_grey(bdpt_builder* builder, float emission) {
  bdpt_material_desc desc = make<bdpt_material_desc>();
  for (int i = 0; i < 3; ++i) desc.reflectance[i] = 0.7f, desc.emission[i] = emission;
  bdpt_material_id material{};
  check(bdpt_material_add(builder, &desc, &material));
  return material;
}

void add_mesh(bdpt_builder* builder, const std::vector<float>& positions, bdpt_material_id material) {
  bdpt_mesh_desc mesh = make<bdpt_mesh_desc>();
  mesh.positions.data = positions.data();
  mesh.positions.count = positions.size() / 3;
  mesh.positions.format = BDPT_FORMAT_FLOAT3;
  bdpt_instance_desc instance = make<bdpt_instance_desc>();
  check(bdpt_mesh_add(builder, &mesh, &instance.shape));
  instance.material = material;
  bdpt_instance_id id{};
  check(bdpt_instance_add(builder, &instance, &id));
}

std::vector<float> quad(const float (&c)[4][3]) {
  std::vector<float> positions;
  for (int i : {0, 1, 2, 0, 2, 3}) positions.insert(positions.end(), c[i], c[i] + 3);
  return positions;
}

// A room of 2 x 2 x 2, open where the camera is, with a lamp in the ceiling: little to trace, so that calls count.
bdpt_scene* build_room(bdpt_context* context) {
  bdpt_builder* builder = nullptr;
  check(bdpt_builder_create(context, &builder));
  const bdpt_material_id grey = add_grey(builder, 0), lamp = add_grey(builder, 10);
  add_mesh(builder, quad({{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}), grey);
  add_mesh(builder, quad({{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}}), grey);
  add_mesh(builder, quad({{-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}}), grey);
  add_mesh(builder, quad({{-1, 0, 1}, {-1, 0, -1}, {-1, 2, -1}, {-1, 2, 1}}), grey);
  add_mesh(builder, quad({{1, 0, -1}, {1, 0, 1}, {1, 2, 1}, {1, 2, -1}}), grey);
  add_mesh(builder, quad({{-0.3f, 1.99f, -0.3f}, {0.3f, 1.99f, -0.3f}, {0.3f, 1.99f, 0.3f}, {-0.3f, 1.99f, 0.3f}}),
           lamp);
  bdpt_scene* scene = nullptr;
  check(bdpt_scene_build(builder, nullptr, &scene));
  bdpt_builder_destroy(builder);
  return scene;
}

bdpt_scene* build_triangle(bdpt_context* context) {
  bdpt_builder* builder = nullptr;
  check(bdpt_builder_create(context, &builder));
  add_mesh(builder, {-1, 0, 0, 1, 0, 0, 0, 1.5f, 0}, add_grey(builder, 1));
  bdpt_scene* scene = nullptr;
  check(bdpt_scene_build(builder, nullptr, &scene));
  bdpt_builder_destroy(builder);
  return scene;
}

struct Room {
  bdpt_context* context = nullptr;
  bdpt_scene* scene = nullptr;
  bdpt_sensor* camera = nullptr;
  clockid_t clock;

  explicit Room(uint32_t threads) : clock(threads == 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC) {
    bdpt_context_desc wanted = make<bdpt_context_desc>();
    wanted.threads = threads;
    check(bdpt_context_create(BDPT_ABI, &wanted, &context));
    scene = build_room(context);
    bdpt_camera_desc desc = make<bdpt_camera_desc>();
    desc.width = desc.height = kSide;
    const float to_world[12] = {1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 3.6f};
    std::copy(to_world, to_world + 12, desc.transform);
    check(bdpt_camera_create(context, &desc, &camera));
  }
  ~Room() {
    bdpt_sensor_release(camera);
    bdpt_scene_release(scene);
    bdpt_context_release(context);
  }

  // Seconds of kPasses passes in calls of `each`, on an empty film. On one thread they are its own, whatever else the
  // machine does.
  double render(uint64_t each, const bdpt_output_sink* sink, bool report) const {
    bdpt_film* film = nullptr;
    bdpt_render* render = nullptr;
    check(bdpt_film_create(camera, nullptr, &film));
    check(bdpt_render_create(scene, camera, film, nullptr, &render));
    bdpt_advance_desc advance = make<bdpt_advance_desc>();
    advance.passes = each;
    advance.sink = sink;
    bdpt_advance_report told = make<bdpt_advance_report>();
    const double begin = clock_seconds(clock);
    for (uint64_t done = 0; done < kPasses; done += each)
      check(bdpt_render_advance(render, &advance, report ? &told : nullptr));
    const double seconds = clock_seconds(clock) - begin;
    bdpt_render_destroy(render);
    bdpt_film_release(film);
    return seconds;
  }
};

struct Way {
  const char* name;
  std::function<double()> seconds;
};

// The median over the turns of each way's time over the first one's in the same turn, once all have been warmed up.
void compare(int turns, const char* title, const std::vector<Way>& ways) {
  std::vector<std::vector<double>> ratios(ways.size());
  std::vector<double> first;
  for (int turn = -1; turn < turns; ++turn) {
    double base = 0;
    for (size_t i = 0; i < ways.size(); ++i) {
      const double seconds = ways[i].seconds();
      if (i == 0) base = seconds;
      if (turn < 0) continue;
      ratios[i].push_back(seconds / base);
      if (i == 0) first.push_back(seconds);
    }
  }
  std::printf("%s, %.1f ms a pass\n", title, 1e3 * median(first) / double(kPasses));
  for (size_t i = 1; i < ways.size(); ++i) std::printf("  %-44s %.4f\n", ways[i].name, median(ratios[i]));
}

double sum_of_tiles = 0;

std::vector<Way> ways_of(const Room& room) {
  static bdpt_output_sink sink = make<bdpt_output_sink>();
  sink.every = 1;
  sink.tile = [](void*, uint32_t x0, uint32_t y0, uint32_t x1, uint32_t y1, const float* pixels) {
    sum_of_tiles += pixels[0] + double((x1 - x0) * (y1 - y0));
    return int32_t(0);
  };
  return {{"one call", [&] { return room.render(kPasses, nullptr, false); }},
          {"a call for each pass", [&] { return room.render(1, nullptr, false); }},
          {"a call and a report for each pass", [&] { return room.render(1, nullptr, true); }},
          {"one call, tiles after each pass", [&] { return room.render(kPasses, &sink, false); }},
          {"a call for each pass, and tiles", [&] { return room.render(1, &sink, false); }}};
}

void count_objects(double seconds) {
  const auto per_second = [&](const std::function<void()>& make_and_give_back) {
    make_and_give_back();
    const double begin = clock_seconds(CLOCK_MONOTONIC);
    uint64_t n = 0;
    for (; clock_seconds(CLOCK_MONOTONIC) - begin < seconds; ++n) make_and_give_back();
    return double(n) / (clock_seconds(CLOCK_MONOTONIC) - begin);
  };
  const auto context = [] {
    bdpt_context* made = nullptr;
    check(bdpt_context_create(BDPT_ABI, nullptr, &made));
    return made;
  };
  std::printf("Made and given back in a second\n");
  std::printf("  contexts                                     %.0f\n",
              per_second([&] { bdpt_context_release(context()); }));
  bdpt_context* kept = context();
  std::printf("  scenes of one triangle                       %.0f\n",
              per_second([&] { bdpt_scene_release(build_triangle(kept)); }));
  bdpt_context_release(kept);
  std::printf("  contexts with a scene of one triangle        %.0f\n", per_second([&] {
                bdpt_context* made = context();
                bdpt_scene_release(build_triangle(made));
                bdpt_context_release(made);
              }));
}

// One of the ways by itself, for who counts instructions: valgrind --tool=callgrind build/bdpt_call_costs count WAY
int run_once(const char* name) {
  const Room room(1);
  for (const Way& way : ways_of(room))
    if (std::strcmp(way.name, name) == 0) return way.seconds(), 0;
  std::fprintf(stderr, "the ways are:\n");
  for (const Way& way : ways_of(room)) std::fprintf(stderr, "  %s\n", way.name);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "count") == 0) return run_once(argv[2]);
  const int turns = argc > 1 ? std::atoi(argv[1]) : 15;
  if (turns < 1) return std::fprintf(stderr, "usage: bdpt_call_costs [TURNS (1 or more)]\n"), 2;
  {
    const Room room(1);
    compare(turns, "Passes of 256 x 256 pixels on one thread, its time over that of one call", ways_of(room));
  }
  {
    const Room room(0);
    compare(turns, "The same on all cores, by the clock", ways_of(room));
  }
  count_objects(1);
  return 0;
}
