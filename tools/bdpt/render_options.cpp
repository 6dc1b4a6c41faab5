// SPDX-License-Identifier: Apache-2.0
#include "render_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "choice_option.h"
#include "handles.h"
#include "render_outputs.h"
#include "view_options.h"

namespace bdpt_tool {
namespace {

constexpr std::uint64_t kDefaultSamples = 64;

const std::map<std::string, bdpt_heuristic> kHeuristics = {
    {"power", BDPT_HEURISTIC_POWER},     {"balance", BDPT_HEURISTIC_BALANCE}, {"cutoff", BDPT_HEURISTIC_CUTOFF},
    {"maximum", BDPT_HEURISTIC_MAXIMUM}, {"average", BDPT_HEURISTIC_AVERAGE}, {"none", BDPT_HEURISTIC_NONE}};
const std::map<std::string, bdpt_order> kOrders = {
    {"metric", BDPT_ORDER_METRIC}, {"hilbert", BDPT_ORDER_HILBERT}, {"none", BDPT_ORDER_NONE}};
const std::map<std::string, bdpt_partners> kPartners = {{"sobol", BDPT_PARTNERS_SOBOL},
                                                        {"latin-hypercube", BDPT_PARTNERS_LATIN_HYPERCUBE}};
const std::map<std::string, bdpt_matrix_kind> kMatrix = {{"per-technique", BDPT_MATRIX_PER_TECHNIQUE},
                                                         {"all-lengths", BDPT_MATRIX_ALL_LENGTHS}};
const std::map<std::string, bdpt_shadow_roulette> kRoulettes = {{"none", BDPT_SHADOW_ROULETTE_NONE},
                                                                {"fixed", BDPT_SHADOW_ROULETTE_FIXED},
                                                                {"efficiency", BDPT_SHADOW_ROULETTE_EFFICIENCY}};
const std::map<std::string, bdpt_light_selection> kLightSelections = {{"power", BDPT_LIGHT_SELECTION_POWER},
                                                                      {"uniform", BDPT_LIGHT_SELECTION_UNIFORM},
                                                                      {"tree", BDPT_LIGHT_SELECTION_TREE},
                                                                      {"each", BDPT_LIGHT_SELECTION_EACH}};
const std::map<std::string, bdpt_light_start> kLightStarts = {{"power", BDPT_LIGHT_START_POWER},
                                                              {"uniform", BDPT_LIGHT_START_UNIFORM},
                                                              {"importance", BDPT_LIGHT_START_IMPORTANCE}};
const std::map<std::string, bdpt_pool_selection> kPoolSelections = {{"uniform", BDPT_POOL_SELECTION_UNIFORM},
                                                                    {"importance", BDPT_POOL_SELECTION_IMPORTANCE}};
const std::map<std::string, bdpt_sampler> kSamplers = {
    {"sobol", BDPT_SAMPLER_SOBOL}, {"independent", BDPT_SAMPLER_INDEPENDENT}, {"stratified", BDPT_SAMPLER_STRATIFIED}};
const std::map<std::string, bdpt_filter> kFilters = {{"box", BDPT_FILTER_BOX},
                                                     {"tent", BDPT_FILTER_TENT},
                                                     {"gaussian", BDPT_FILTER_GAUSSIAN},
                                                     {"mitchell", BDPT_FILTER_MITCHELL},
                                                     {"blackman-harris", BDPT_FILTER_BLACKMAN_HARRIS}};
const std::map<std::string, bdpt_normalization> kNormalizations = {
    {"weights", BDPT_NORMALIZATION_FILTER_WEIGHTS_BIASED}, {"count", BDPT_NORMALIZATION_SAMPLE_COUNT}};

// path and light are sets of techniques; all else are plans, and the first of them is the default.
std::vector<std::string> integrators() {
  std::vector<std::string> names = {"path", "light", "bdpt"};
  for (std::uint32_t i = 1; bdpt_plan_name(i); ++i) names.push_back(bdpt_plan_name(i));
  return names;
}
std::string plan_list() {
  std::string text = bdpt_plan_summary(0);
  for (std::uint32_t i = 1; bdpt_plan_name(i); ++i)
    text += std::string(". ") + bdpt_plan_name(i) + ": " + bdpt_plan_summary(i);
  return text;
}

void add_output_options(CLI::App& command, RenderOptions& options) {
  command.add_option("-o,--output", options.output, "The picture, OpenEXR, with a layer 'variance'")->required();
  command.add_option("--png", options.png, "The picture through the display transform, PNG");
  command.add_option("--outputs", options.outputs, kOutputsHelp)->type_name("LIST");
  command.add_flag(
      "--denoise", options.denoise,
      "Write the picture without noise, by Open Image Denoise, if it is installed; the layer 'noisy' is as "
      "it was rendered");
  add_film_options(command, options);
  command.add_option("--pyramid", options.pyramid,
                     "Folder for the picture of each technique (s,t), and pyramid.png with all of them; row k is "
                     "over-exposed by k-1 stops");
  add_color_options(command, options.color, options.view);
  command.add_flag("--json", options.json, "Print one JSON object about the render on stdout");
}

void add_image_options(CLI::App& command, RenderOptions& options) {
  command
      .add_option("--width", options.width,
                  "Width of the picture in pixels (default: the file's, or by its shape for the height)")
      ->check(CLI::Range(1, 65536));
  command
      .add_option("--height", options.height,
                  "Height of the picture in pixels (default: the file's, or by its shape for the width)")
      ->check(CLI::Range(1, 65536));
  add_camera_options(command, options.camera);
  add_choice(command, "--filter", options.filter, kFilters,
             "box, tent, gaussian, mitchell or blackman-harris (default: the file's; of a cube map box, the only one)");
  command.add_option("--filter-radius", options.filter_radius, "In pixels (default: the filter's own)")
      ->check(CLI::Range(0.5, 8.0));
  add_choice(command, "--normalization", options.normalization, kNormalizations,
             "weights (default; less noise, slightly biased) or count (unbiased)");
}

std::uint64_t parse_pass(std::string_view text) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec == std::errc() && result.ptr == end) return value;
  throw Error(ExitCode::kUsage, "--passes: '" + std::string(text) + "' is no number; write A:B, such as 0:64");
}

}  // namespace

void add_film_options(CLI::App& command, RenderOptions& options) {
  command.add_option("--film", options.film, "Save the film, to merge or to go on from; an old one is replaced");
  command.add_flag("--resume", options.resume, "If the file of --film is there, load it and go on from it");
  command
      .add_option("--checkpoint", options.checkpoint,
                  "Save the film after so many seconds, too, each time (default 60; 0: at the end alone)")
      ->check(CLI::NonNegativeNumber);
}

void add_limit_options(CLI::App& command, RenderOptions& options) {
  command
      .add_option("--spp", options.samples_per_pixel,
                  "Samples per pixel N: the passes 0:N (default: the file's, or 64)")
      ->check(positive());
  command.add_option("--passes", options.passes, "Passes A:B, from A up to but without B, for renders to be merged")
      ->excludes("--spp");
  command.add_option("--time", options.seconds, "Stop after this many seconds")->check(positive());
  command.add_option("--noise", options.noise, "Stop at this relative error")->check(positive());
  command.add_option("--seed", options.seed, "Of the random numbers (default 0)");
}

void add_method_options(CLI::App& command, RenderOptions& options) {
  command.add_option("--max-edges", options.max_edges, "Longest path, k edges; 0 = no limit (default: maxdepth + 1)");
  command
      .add_option(
          "--integrator", options.integrator,
          "Default bdpt, whatever the file names. path: path tracing. light: light tracing. bdpt: " + plan_list())
      ->check(CLI::IsMember(integrators()))
      ->type_name("NAME");
  command
      .add_option("--connections", options.connections, "Light vertices that each eye vertex meets (pooled, matrix)")
      ->check(positive());
  command
      .add_option("--pool-passes", options.pool_passes, "Passes taken at once (matrix, automatic: default 8; mmlt: 16)")
      ->check(positive());
  command.add_option("--pool-pixels", options.pool_pixels, "Pixels of a pool in matrix (default 256)")
      ->check(positive());
  add_choice(command, "--matrix", options.matrix, kMatrix,
             "Matrices of matrix: per-technique (default) or all-lengths");
  add_choice(command, "--order", options.order, kOrders,
             "Order of subpaths in matrix: metric (default), hilbert, none");
  add_choice(command, "--partners", options.partners, kPartners,
             "How matrix chooses partners: sobol (default) or latin-hypercube");
  add_choice(
      command, "--pool-selection", options.pool_selection, kPoolSelections,
      "How pooled chooses light vertices: uniform (default), or importance: half by the light that arrives there");
  command.add_option("--light-samples", options.light_samples, "Light subpaths for each eye subpath (default 1)")
      ->check(positive());
  add_choice(command, "--roulette", options.roulette, kRoulettes,
             "Which connections are tested for visibility: none: all (default); fixed: by --roulette-threshold; "
             "efficiency: by the noise per ray in each region of the picture (Veach 10.4)");
  command
      .add_option("--roulette-threshold", options.roulette_threshold,
                  "Contributions below it, in units of a pixel's value, are tested in proportion (--roulette fixed)")
      ->check(positive());
  command.add_flag("--adaptive", options.adaptive,
                   "More samples where the picture is noisy and fewer where it is not, as many in all (Veach 10.3.6); "
                   "best with --spp a multiple of 8");
  add_choice(command, "--light-start", options.light_start, kLightStarts,
             "How light subpaths choose a light: power (default), uniform, or importance: what it brings to this view");
  add_choice(command, "--light-selection", options.light_selection, kLightSelections,
             "How direct lighting chooses a light: power (default), uniform, tree (for many lights), or each in turn");
  command
      .add_option("--direct-samples", options.direct_samples,
                  "Points on lights that direct lighting takes at each vertex (default 1)")
      ->check(positive());
  command
      .add_option("--direct-candidates", options.direct_candidates,
                  "Each of them chosen among so many by its contribution without shadows (default 1)")
      ->check(positive());
  command.add_option("--techniques", options.techniques, kTechniqueMaskHelp)
      ->excludes("--integrator")
      ->type_name("MASK");
  add_choice(command, "--heuristic", options.heuristic, kHeuristics,
             "power (default), balance, cutoff, maximum, average or none");
  command.add_option("--beta", options.beta, "Exponent of the power heuristic (default 2)")->check(positive());
  command.add_option("--cutoff", options.cutoff, "Threshold of the cutoff heuristic, 0 to 1")
      ->check(CLI::Range(0.0, 1.0));
  command.add_flag("--correlation-aware", options.correlation_aware,
                   "Weights count connections that share an eye subpath as fewer (Grittmann et al. 2021); slower");
  add_choice(command, "--sampler", options.sampler, kSamplers, "sobol (default), independent or stratified");
}

void add_render_options(CLI::App& command, RenderOptions& options) {
  command.add_option("file", options.scene, "A scene file: pbrt-v4, glTF 2.0 (.gltf, .glb), OBJ or PLY")->required();
  add_read_options(command, options.read);
  add_output_options(command, options);
  add_limit_options(command, options);
  add_image_options(command, options);
  add_method_options(command, options);
  command.add_option("--threads", options.threads, "Threads that render (default: one per core)");
  command.footer(
      "Of several limits the first one reached counts. Ctrl-C stops and writes what is finished (exit code 130), a "
      "second Ctrl-C ends the program at once. " +
      std::string(kExitCodeHelp));
}

PictureSize picture_size(const RenderOptions& options, const FilmDescription& film) {
  const auto side = [](double pixels) { return static_cast<std::uint32_t>(std::clamp(std::round(pixels), 1.0, 4e9)); };
  const double shape = double(film.width) / film.height;
  if (options.width && !options.height) return {*options.width, side(*options.width / shape)};
  if (options.height && !options.width) return {side(*options.height * shape), *options.height};
  return {options.width.value_or(film.width), options.height.value_or(film.height)};
}

PassRange pass_range(const RenderOptions& options, std::optional<std::uint32_t> samples_in_file) {
  if (!options.passes.empty()) {
    const std::size_t colon = options.passes.find(':');
    if (colon == std::string::npos) throw Error(ExitCode::kUsage, "--passes: write A:B, such as 0:64");
    const std::string_view text = options.passes;
    const PassRange range = {parse_pass(text.substr(0, colon)), parse_pass(text.substr(colon + 1))};
    if (range.first >= range.end) throw Error(ExitCode::kUsage, "--passes: the range is empty");
    return range;
  }
  if (options.samples_per_pixel) return {0, *options.samples_per_pixel};
  if (options.seconds > 0 || options.noise > 0) return {0, 0};
  return {0, samples_in_file.value_or(kDefaultSamples)};
}

TechniqueMask technique_mask(const RenderOptions& options) {
  if (!options.techniques.empty()) return parse_technique_mask(options.techniques);
  if (options.integrator == "path") return parse_technique_mask("s<=1&t>=2");
  if (options.integrator == "light") return parse_technique_mask("t<=1");
  return parse_technique_mask("all");
}

const char* plan_name(const RenderOptions& options) {
  for (std::uint32_t i = 1; bdpt_plan_name(i); ++i)
    if (options.integrator == bdpt_plan_name(i)) return bdpt_plan_name(i);
  return nullptr;
}

bdpt_render_desc render_desc(const RenderOptions& options, const TechniqueMask& techniques, std::uint64_t first_pass,
                             std::uint32_t max_edges) {
  auto desc = sized<bdpt_render_desc>();
  desc.max_edges = max_edges;
  desc.seed = options.seed;
  desc.first_pass = first_pass;
  std::copy(techniques.begin(), techniques.end(), desc.techniques);
  desc.heuristic = options.heuristic;
  desc.beta = options.beta;
  desc.cutoff = options.cutoff;
  desc.sampler = options.sampler;
  desc.plan = plan_name(options);
  desc.connections = options.connections;
  desc.light_samples = options.light_samples;
  desc.pool_passes = options.pool_passes;
  desc.pool_pixels = options.pool_pixels;
  desc.matrix = options.matrix;
  desc.order = options.order;
  desc.partners = options.partners;
  desc.shadow_roulette = options.roulette;
  desc.shadow_threshold = options.roulette_threshold;
  desc.adaptive = options.adaptive ? BDPT_ADAPTIVE_TWO_STAGES : BDPT_ADAPTIVE_NONE;
  desc.pool_selection = options.pool_selection;
  desc.correlation_aware = options.correlation_aware;
  desc.light_start = options.light_start;
  desc.light_selection = options.light_selection;
  desc.direct_samples = options.direct_samples;
  desc.direct_candidates = options.direct_candidates;
  return desc;
}

}  // namespace bdpt_tool
