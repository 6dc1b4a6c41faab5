// What `bdpt render` tells about its work.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "handles.h"

namespace bdpt_tool {

struct RenderReport {
  double load_seconds = 0, build_seconds = 0, render_seconds = 0;
  bdpt_render_stats stats = sized<bdpt_render_stats>();
  bdpt_film_info film = sized<bdpt_film_info>();
  bdpt_scene_info scene = sized<bdpt_scene_info>();
  bdpt_context_info context = sized<bdpt_context_info>();
  std::size_t warnings = 0;
  bool interrupted = false;
};

// One JSON object, to stdout.
void print_json(const RenderReport& report);

// A line for people, to stderr.
void print_summary(const RenderReport& report);

}  // namespace bdpt_tool
