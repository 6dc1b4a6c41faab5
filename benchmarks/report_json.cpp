// SPDX-License-Identifier: Apache-2.0
#include "report_json.h"

#include <optional>
#include <utility>

#include "json.h"
#include "targets.h"

namespace bdpt_benchmark {
namespace {

using bdpt_tool::JsonWriter;

void write(JsonWriter& out, const Setting& setting) {
  out.open("setting");
  out.value("version", setting.version);
  out.value("processor", setting.processor);
  out.value("cores", setting.cores);
  out.value("threads", setting.threads);
  out.value("isa", setting.isa);
  out.value("embree", setting.embree);
  out.value("quick", setting.quick);
  out.close();
}

void write(JsonWriter& out, const MemoryResult& memory) {
  out.open("memory");
  out.value("context_peak", memory.context_peak);
  out.value("process_peak", memory.process_peak);
  out.value("process_before", memory.process_before);
  out.value("film", memory.film);
  out.value("embree", memory.embree);
  out.value("arrays", memory.arrays);
  out.value("used", memory.used);
  out.value("allowed", memory.allowed);
  out.close();
}

void write(JsonWriter& out, const StageShares& stages) {
  out.open("stages");
  out.value("start", stages.start);
  out.value("extend", stages.extend);
  out.value("extend_rays", stages.rays);
  out.value("connect", stages.connect);
  out.value("shadow", stages.shadow);
  out.value("accumulate", stages.accumulate);
  out.value("rest", stages.rest);
  out.close();
}

void write(JsonWriter& out, const std::optional<Verdict>& verdict) {
  if (!verdict) return;
  out.open(verdict->figure);
  out.value("value", verdict->value);
  out.value(verdict->at_most ? "at_most" : "at_least", verdict->limit);
  out.value("met", verdict->met());
  out.close();
}

void write(JsonWriter& out, const Results& results, const SceneResult& scene, const IntegratorResult& r) {
  out.open(r.name);
  out.value("samples_per_second", r.samples_per_second);
  out.value("eye_rays_per_second", r.eye_rays_per_second);
  out.value("light_rays_per_second", r.light_rays_per_second);
  out.value("shadow_rays_per_second", r.shadow_rays_per_second);
  write(out, r.stages);
  out.value("replayed_rays", r.replayed_rays);
  out.value("replay_ratio", r.replay_ratio);
  out.value("cost", r.cost);
  out.value("image_mean", r.image_mean);
  out.value("relative_variance", r.relative_variance);
  out.value("variance_seconds", r.variance_seconds);
  out.value("efficiency", r.efficiency);
  out.value("scaling", r.scaling);
  out.value("replay_scaling", r.replay_scaling);
  out.open("targets");
  write(out, judge_replay(scene, r));
  write(out, judge_cost(scene, r));
  write(out, judge_efficiency(scene, r));
  write(out, judge_scaling(results, r));
  out.close();
  out.close();
}

}  // namespace

std::string json(const Results& results) {
  JsonWriter out;
  write(out, results.setting);
  out.open("scenes");
  for (const SceneResult& scene : results.scenes) {
    out.open(scene.name);
    out.value("width", scene.width);
    out.value("height", scene.height);
    out.value("triangles", scene.triangles);
    write(out, scene.memory);
    out.open("targets");
    write(out, std::optional(judge_memory(scene)));
    out.close();
    out.open("integrators");
    for (const IntegratorResult& integrator : scene.integrators) write(out, results, scene, integrator);
    out.close();
    out.close();
  }
  out.close();
  return std::move(out).finish();
}

}  // namespace bdpt_benchmark
