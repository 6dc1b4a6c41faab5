// SPDX-License-Identifier: Apache-2.0
#include "render_report.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>

#include "json.h"

namespace bdpt_tool {
namespace {

std::uint64_t max_resident_bytes() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

const char* isa_name(bdpt_isa isa) {
  switch (isa) {
    case BDPT_ISA_SSE42:
      return "sse4.2";
    case BDPT_ISA_AVX2:
      return "avx2";
    case BDPT_ISA_AVX512:
      return "avx512";
    default:
      return "unknown";
  }
}

void write_work(JsonWriter& json, const bdpt_render_stats& stats) {
  json.open("rays");
  json.value("eye", stats.eye_rays);
  json.value("light", stats.light_rays);
  json.value("shadow", stats.shadow_rays);
  json.value("shadow_blocked", stats.shadow_rays_blocked);
  json.close();
  json.value("shadow_rays_skipped", stats.shadow_rays_skipped);
  json.value("connections", stats.connections);
  if (stats.mutations > 0) {
    json.value("mutations", stats.mutations);
    json.value("accepted", stats.accepted);
  }
  json.value("light_samples", std::uint64_t(stats.light_samples));
  if (stats.share_path + stats.share_two_way + stats.share_one_to_one + stats.share_matrix > 0) {
    json.open("strategies");
    json.value("path", stats.share_path);
    json.value("two-way", stats.share_two_way);
    json.value("one-to-one", stats.share_one_to_one);
    json.value("matrix", stats.share_matrix);
    json.close();
  }
  json.open("thread_seconds");
  json.value("start", stats.seconds_start);
  json.value("extend", stats.seconds_extend);
  json.value("extend_rays", stats.seconds_extend_rays);
  json.value("connect", stats.seconds_connect);
  json.value("shadow", stats.seconds_shadow);
  json.value("accumulate", stats.seconds_accumulate);
  json.close();
}

void write_techniques(JsonWriter& json, const std::vector<TechniqueReport>& techniques) {
  json.open("techniques");
  for (const TechniqueReport& t : techniques) {
    json.open(std::to_string(t.s) + "x" + std::to_string(t.t));
    json.value("energy", t.stats.energy);
    json.value("squares", t.stats.squares);
    json.value("contributions", t.stats.contributions);
    json.value("shadow", t.stats.shadow_rays);
    json.value("shadow_blocked", t.stats.shadow_rays_blocked);
    json.value("shadow_skipped", t.stats.shadow_rays_skipped);
    json.value("thread_seconds", t.stats.seconds);
    json.close();
  }
  json.close();
}

}  // namespace

std::vector<TechniqueReport> read_techniques(const bdpt_render* render) {
  std::vector<TechniqueReport> techniques;
  for (std::uint32_t k = 1; k <= 61; ++k)
    for (std::uint32_t s = k + 1 > 31 ? k + 1 - 31 : 0; s <= std::min(k + 1, 31u); ++s) {
      TechniqueReport t{s, k + 1 - s, sized<bdpt_technique_stats>()};
      check(bdpt_render_get_technique_stats(render, t.s, t.t, &t.stats), "the render");
      if (t.stats.energy > 0 || t.stats.contributions > 0) techniques.push_back(t);
    }
  return techniques;
}

void print_json(const RenderReport& report) {
  JsonWriter json;
  json.open("seconds");
  json.value("load", report.load_seconds);
  json.value("build", report.build_seconds);
  json.value("render", report.render_seconds);
  json.close();
  json.value("width", report.film.width);
  json.value("height", report.film.height);
  json.value("passes", report.stats.passes);
  json.value("samples", report.stats.samples);
  write_work(json, report.stats);
  write_techniques(json, report.techniques);
  json.open("film");
  json.value("passes", report.film.passes);
  json.value("first_pass", report.film.first_pass);
  json.value("next_pass", report.film.next_pass);
  json.close();
  json.value("relative_error", report.film.relative_error);
  json.value("rejected", report.stats.rejected);
  json.open("memory");
  json.value("library_peak", report.context.memory_peak);
  json.value("scene", report.scene.memory);
  json.value("process_peak", max_resident_bytes());
  json.close();
  json.value("threads", report.context.threads);
  json.value("isa", isa_name(report.context.isa));
  json.value("triangles", report.scene.triangles);
  json.value("lights", report.scene.lights);
  json.value("warnings", report.warnings);
  json.value("interrupted", report.interrupted);
  std::fputs(std::move(json).finish().c_str(), stdout);
}

void print_summary(const RenderReport& report) {
  const double rate = report.render_seconds > 0 ? static_cast<double>(report.stats.samples) / report.render_seconds : 0;
  std::fprintf(stderr, "%llu passes, %.2f s load, %.2f s build, %.2f s render, %.3f M samples/s",
               static_cast<unsigned long long>(report.stats.passes), report.load_seconds, report.build_seconds,
               report.render_seconds, rate / 1e6);
  if (report.film.relative_error >= 0) std::fprintf(stderr, ", relative error %.4g", report.film.relative_error);
  if (report.stats.rejected > 0) {
    std::fprintf(stderr, ", %llu contributions rejected", static_cast<unsigned long long>(report.stats.rejected));
  }
  std::fputs("\n", stderr);
}

}  // namespace bdpt_tool
