// How long a large scene takes to read and build, against Embree's own building of the same triangles, and how much
// memory copies of it take: flattened, and as instances.
//
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "api/handles.h"
#include "geometry/embree.h"
#include "integrator.h"
#include "process_memory.h"
#include "render/executor.h"
#include "render_run.h"
#include "scene_set.h"
#include "scene_upload.h"
#include "stopwatch.h"
#include "timing.h"

namespace bdpt_benchmark {
namespace {

using bdpt_tool::SceneDescription;
using bdpt_tool::Stopwatch;

constexpr int kTurns = 5;
constexpr double kMiB = 1024 * 1024;
constexpr std::uint64_t kBillion = 1'000'000'000;

bdpt::Transform transform_of(const bdpt_tool::InstanceDescription& instance) {
  bdpt::Transform t;
  std::copy(instance.transform.begin(), instance.transform.end(), &t.m[0]);
  return t;
}

// The triangles of a scene as Embree takes them, where they stand in the world.
class Triangles {
 public:
  Triangles(const SceneDescription& description, const bdpt::Scene& scene) {
    positions_.reserve(scene.instance_count());
    for (std::uint32_t i = 0; i < scene.instance_count(); ++i) {
      const bdpt::Mesh* mesh = scene.mesh(i);
      if (!mesh) continue;
      const bdpt::Transform to_world = transform_of(description.instances[i]);
      auto& world = positions_.emplace_back();
      for (std::size_t k = 0; k < mesh->positions.size(); ++k) world.push_back(to_world.point(mesh->positions[k]));
      world.resize(world.size() + 2);
      bdpt::RayGeometry geometry;
      geometry.mesh = mesh;
      geometry.world_positions = {world.data(), mesh->positions.size(), sizeof(bdpt::Vec3)};
      geometries_.push_back(geometry);
    }
  }

  double build_seconds(const std::shared_ptr<bdpt::RayDevice>& device) const {
    const Stopwatch watch;
    const bdpt::RayScene rays(device, geometries_, [](double) { return true; });
    return watch.seconds();
  }

 private:
  std::vector<std::vector<bdpt::Vec3>> positions_;
  std::vector<bdpt::RayGeometry> geometries_;
};

struct Run {
  double load = 0, build = 0, embree = 0, first_picture = 0;
};

Run run_once(const std::string& path, std::uint32_t threads, bdpt_tool::Diagnostics& diagnostics) {
  Run run;
  const Stopwatch watch;
  LoadedScene loaded = load_scene({"", path}, 640, threads, diagnostics, [&] { run.load = watch.seconds(); });
  run.build = watch.seconds() - run.load;
  RenderRun render(loaded, integrators().back(), bdpt::make_pool(threads));
  render.advance(1);
  run.first_picture = watch.seconds();
  return run;
}

void time_reading(const std::string& path, std::uint32_t threads) {
  bdpt_tool::Diagnostics silent(false);
  SceneDescription description = bdpt_tool::read_scene(path, silent);
  const bdpt_tool::Context context = bdpt_tool::make_context(threads, silent);
  const bdpt_tool::Scene scene = bdpt_tool::build_scene(context.get(), description);
  const Triangles triangles(description, *scene->scene);
  const auto device = std::make_shared<bdpt::RayDevice>(bdpt::Isa::Best, std::make_shared<bdpt::MemoryMeter>(0));
  std::vector<double> load, build, embree, first, ratio;
  for (int turn = 0; turn < kTurns; ++turn) {
    const Run run = run_once(path, threads, silent);
    load.push_back(run.load);
    build.push_back(run.build);
    first.push_back(run.first_picture);
    embree.push_back(triangles.build_seconds(device));
    ratio.push_back((run.load + run.build) / embree.back());
  }
  std::printf("triangles               %llu\n", static_cast<unsigned long long>(scene->scene->info().triangles));
  std::printf("read                    %.3f s\n", median(load));
  std::printf("build, Embree included  %.3f s\n", median(build));
  std::printf("Embree alone            %.3f s\n", median(embree));
  std::printf("read and build / Embree %.2f (target: at most 2)\n", median(ratio));
  std::printf("to the first picture    %.3f s, 640 pixels wide, one sample a pixel, all techniques\n", median(first));
}

// Copies beside one another; with meshes of their own, or as instances of the same.
void copy(SceneDescription& description, std::uint64_t copies, const std::string& path, bool own_meshes) {
  constexpr float kStep = 100;
  bdpt_tool::Diagnostics silent(false);
  const std::size_t instances = description.instances.size(), shapes = description.shapes.size();
  description.instances.reserve(copies * instances);
  for (std::uint64_t c = 1; c < copies; ++c) {
    if (own_meshes) {
      SceneDescription other = bdpt_tool::read_scene(path, silent);
      std::move(other.shapes.begin(), other.shapes.end(), std::back_inserter(description.shapes));
    }
    for (std::size_t i = 0; i < instances; ++i) {
      auto instance = description.instances[i];
      if (own_meshes) instance.shape += static_cast<int>(c * shapes);
      instance.transform[3] += static_cast<float>(c % 32) * kStep;
      instance.transform[7] += static_cast<float>(c / 32) * kStep;
      description.instances.push_back(instance);
    }
  }
}

struct Memory {
  std::uint64_t triangles = 0;
  double used = 0, booked = 0, allowed = 0;
  double seconds = 0;
};

Memory measure_copies(const std::string& path, std::uint64_t copies, bool own_meshes, std::uint32_t threads) {
  bdpt_tool::Diagnostics silent(false);
  const std::uint64_t before = resident_now();
  LoadedScene loaded;
  const Stopwatch watch;
  {
    SceneDescription description = bdpt_tool::read_scene(path, silent);
    copy(description, copies, path, own_meshes);
    reset_resident_peak();
    loaded = build_loaded(std::move(description), 64, threads, silent);
  }
  Memory memory;
  memory.seconds = watch.seconds();
  memory.triangles = loaded.scene->info().triangles;
  const double embree = double(loaded.scene->info().memory_embree);
  memory.used = std::max(double(resident_peak()) - double(before), double(loaded.meter->peak()));
  memory.booked = double(loaded.meter->peak());
  memory.allowed = 1.3 * (embree + double(loaded.array_bytes())) + 64 * kMiB;
  return memory;
}

void measure_memory(const std::string& path, std::uint32_t threads) {
  const Memory four = measure_copies(path, 4, true, threads);
  std::printf("four flattened copies   %.1f million triangles, %.0f MiB used, %.0f booked (target: at most %.0f)\n",
              double(four.triangles) * 1e-6, four.used / kMiB, four.booked / kMiB, four.allowed / kMiB);
  const std::uint64_t copies = kBillion / (four.triangles / 4) + 1;
  const Memory many = measure_copies(path, copies, false, threads);
  std::printf("%llu instanced copies  %.3f billion triangles, %.0f MiB used (target: at most 1024), %.1f s\n",
              static_cast<unsigned long long>(copies), double(many.triangles) * 1e-9, many.used / kMiB, many.seconds);
}

}  // namespace
}  // namespace bdpt_benchmark

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "Usage: bdpt_large_scene SCENE\n");
    return 2;
  }
  try {
    const std::uint32_t threads = std::thread::hardware_concurrency();
    bdpt_benchmark::time_reading(argv[1], threads);
    bdpt_benchmark::measure_memory(argv[1], threads);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bdpt_large_scene: %s\n", error.what());
    return 1;
  }
}
