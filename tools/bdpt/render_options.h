// The options of `bdpt render`.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "camera_options.h"
#include "film_output.h"
#include "scene_read.h"
#include "technique_mask.h"

namespace CLI {
class App;
}

namespace bdpt_tool {

// What is not given is empty: the scene file decides, or a default.
struct RenderOptions {
  ReadOptions read;
  std::string scene, output, png, film, pyramid;
  std::string outputs;
  bool denoise = false;
  std::optional<std::uint64_t> samples_per_pixel;
  double seconds = 0, noise = 0, checkpoint = 60;
  std::string passes;  // "A:B"
  std::uint64_t seed = 0;
  std::optional<std::uint32_t> width, height, max_edges;
  std::string integrator, techniques;
  std::uint32_t connections = 0, light_samples = 0, pool_passes = 0, pool_pixels = 0;  // 0 = the default
  bdpt_matrix_kind matrix = BDPT_MATRIX_PER_TECHNIQUE;
  bdpt_order order = BDPT_ORDER_METRIC;
  bdpt_partners partners = BDPT_PARTNERS_SOBOL;
  bdpt_shadow_roulette roulette = BDPT_SHADOW_ROULETTE_NONE;
  float roulette_threshold = 0;
  bool adaptive = false;
  bdpt_pool_selection pool_selection = BDPT_POOL_SELECTION_UNIFORM;
  bdpt_light_start light_start = BDPT_LIGHT_START_POWER;
  bdpt_light_selection light_selection = BDPT_LIGHT_SELECTION_POWER;
  std::uint32_t direct_samples = 0, direct_candidates = 0;  // 0 = the default
  bdpt_heuristic heuristic = BDPT_HEURISTIC_POWER;
  float beta = 0, cutoff = 0;
  bool correlation_aware = false;
  bdpt_sampler sampler = BDPT_SAMPLER_SOBOL;
  CameraOptions camera;
  std::optional<bdpt_filter> filter;
  float filter_radius = 0;
  bdpt_normalization normalization = BDPT_NORMALIZATION_FILTER_WEIGHTS_BIASED;
  ViewOptions view;
  ColorOptions color;
  std::uint32_t threads = 0;
  bool json = false, resume = false;
};

void add_render_options(CLI::App& command, RenderOptions& options);
// Those of them that say how long, and by which method.
void add_film_options(CLI::App& command, RenderOptions& options);
void add_limit_options(CLI::App& command, RenderOptions& options);
void add_method_options(CLI::App& command, RenderOptions& options);

// Which passes to sample: [first, end), end 0 = until another limit is reached.
struct PassRange {
  std::uint64_t first = 0, end = 0;
};

// From --passes, --spp, or the file; a limit of time or noise alone leaves the end open. Throws an Error of kUsage.
PassRange pass_range(const RenderOptions& options, std::optional<std::uint32_t> samples_in_file);

struct PictureSize {
  std::uint32_t width, height;
};
// The file's; where one side alone is asked for, of the file's shape.
PictureSize picture_size(const RenderOptions& options, const FilmDescription& film);

// From --techniques or --integrator; all by default. Throws an Error of kUsage.
TechniqueMask technique_mask(const RenderOptions& options);
// The connection plan that --integrator names; the default where it names techniques.
const char* plan_name(const RenderOptions& options);

bdpt_render_desc render_desc(const RenderOptions& options, const TechniqueMask& techniques, std::uint64_t first_pass,
                             std::uint32_t max_edges);

}  // namespace bdpt_tool
