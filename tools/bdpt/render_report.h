// What `bdpt render` tells about its work.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "handles.h"

namespace bdpt_tool {

struct TechniqueReport {
  std::uint32_t s, t;
  bdpt_technique_stats stats;
};

struct RenderReport {
  double load_seconds = 0, build_seconds = 0, render_seconds = 0;
  bdpt_render_stats stats = sized<bdpt_render_stats>();
  std::vector<TechniqueReport> techniques;
  bdpt_film_info film = sized<bdpt_film_info>();
  bdpt_scene_info scene = sized<bdpt_scene_info>();
  bdpt_context_info context = sized<bdpt_context_info>();
  std::size_t warnings = 0;
  bool interrupted = false;
};

// Those that did anything, shortest paths first.
std::vector<TechniqueReport> read_techniques(const bdpt_render* render);

// One JSON object, to stdout.
void print_json(const RenderReport& report);

// A line for people, to stderr.
void print_summary(const RenderReport& report);

}  // namespace bdpt_tool
