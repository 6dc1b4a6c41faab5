// SPDX-License-Identifier: Apache-2.0
#include "pbrt/render_options.h"

#include <cmath>

namespace bdpt_tool {
namespace {

constexpr std::int64_t kMaxPixels = 65536;

std::uint32_t resolution(const ParamList& params, const std::string& name, int fallback) {
  const int value = params.get_int(name, fallback);
  if (value < 1 || value > kMaxPixels) params.fail(name + " must be between 1 and 65536");
  return static_cast<std::uint32_t>(value);
}

void read_crop(const ParamList& params, FilmDescription& film) {
  const std::vector<float> window = params.get_floats("cropwindow");
  if (!window.empty()) {
    if (window.size() != 4) params.fail("cropwindow needs four numbers: x0 x1 y0 y1");
    for (float x : window) {
      if (!(x >= 0 && x <= 1)) params.fail("cropwindow must be between 0 and 1");
    }
    if (!(window[0] < window[1] && window[2] < window[3])) params.fail("cropwindow is empty");
    film.crop_fractions = {window[0], window[1], window[2], window[3]};
  }
  const Param* bounds = params.find("pixelbounds");
  if (!bounds) return;
  if (bounds->type != "integer" || bounds->numbers.size() != 4) {
    params.fail(*bounds, "must be four integers: x0 x1 y0 y1");
  }
  std::array<std::int64_t, 4> pixels;
  for (int i = 0; i < 4; ++i) {
    if (!(bounds->numbers[i] >= 0 && bounds->numbers[i] <= kMaxPixels)) params.fail(*bounds, "is out of range");
    pixels[i] = static_cast<std::int64_t>(bounds->numbers[i]);
  }
  if (pixels[0] >= pixels[1] || pixels[2] >= pixels[3]) params.fail(*bounds, "is empty");
  film.crop_pixels = pixels;
}

// The library's filters are as wide as high.
float filter_radius(const ParamList& params, float fallback, Diagnostics& diagnostics) {
  const float x = params.get_float("xradius", fallback);
  const float y = params.get_float("yradius", fallback);
  const float radius = std::max(x, y);
  if (x != y) diagnostics.warn(params.where(), params.directive() + ": one radius for both axes, the greater is used");
  if (!(radius >= 0.5f && radius <= 8)) params.fail("the radius must be between 0.5 and 8 pixels");
  return radius;
}

}  // namespace

void read_film(const std::string& type, const ParamList& params, SceneDescription& scene, Diagnostics& diagnostics) {
  if (type != "rgb" && type != "gbuffer") params.fail("the film '" + type + "' is not known; use rgb");
  if (type == "gbuffer")
    diagnostics.warn(params.where(), params.directive() + ": only the picture is made, as by \"rgb\"");
  FilmDescription film = scene.film;
  film.width = resolution(params, "xresolution", 1280);
  film.height = resolution(params, "yresolution", 720);
  read_crop(params, film);
  film.diagonal = params.get_float("diagonal", 35);
  if (!(film.diagonal > 0)) params.fail("diagonal must be greater than zero");
  for (const char* name : {"filename", "savefp16", "coordinatesystem"}) params.ignore(name);
  for (const char* name : {"iso", "exposuretime", "whitebalance", "sensor"}) {
    params.warn_ignored(name, "is ignored: pixels hold the scene's radiance", diagnostics);
  }
  params.warn_ignored("maxcomponentvalue", "is ignored: nothing is clamped", diagnostics);
  params.warn_unused(diagnostics);
  scene.film = film;
}

void read_filter(const std::string& type, const ParamList& params, SceneDescription& scene, Diagnostics& diagnostics) {
  FilmDescription& film = scene.film;
  film.filter_a = film.filter_b = 0;
  if (type == "box") {
    film.filter = BDPT_FILTER_BOX;
    film.filter_radius = filter_radius(params, 0.5f, diagnostics);
  } else if (type == "triangle") {
    film.filter = BDPT_FILTER_TENT;
    film.filter_radius = filter_radius(params, 2, diagnostics);
  } else if (type == "mitchell") {
    film.filter = BDPT_FILTER_MITCHELL;
    film.filter_radius = filter_radius(params, 2, diagnostics);
    film.filter_a = params.get_float("B", 1.0f / 3);
    film.filter_b = params.get_float("C", 1.0f / 3);
  } else {
    film.filter = BDPT_FILTER_GAUSSIAN;
    film.filter_radius = 1.5f;
    film.filter_a = 0.5f;
    if (type == "gaussian") {
      film.filter_radius = filter_radius(params, 1.5f, diagnostics);
      film.filter_a = params.get_float("sigma", 0.5f);
      if (!(film.filter_a > 0)) params.fail("sigma must be greater than zero");
    } else {
      diagnostics.warn(params.where(), params.directive() + ": this filter is not known, a gaussian is used");
      return;
    }
  }
  params.warn_unused(diagnostics);
}

void read_sampler(const std::string& type, const ParamList& params, SceneDescription& scene, Diagnostics&) {
  // Which points are used is the program's choice; the count of samples is the file's.
  std::int64_t samples = 0;
  if (type == "stratified") {
    samples = std::int64_t{params.get_int("xsamples", 4)} * params.get_int("ysamples", 4);
  } else {
    if (!params.has("pixelsamples")) return;
    samples = params.get_int("pixelsamples", 16);
  }
  if (samples < 1 || samples > std::int64_t{1} << 30) params.fail("the number of samples is out of range");
  scene.samples_per_pixel = static_cast<std::uint32_t>(samples);
}

void read_integrator(const std::string&, const ParamList& params, SceneDescription& scene, Diagnostics& diagnostics) {
  const int depth = params.get_int("maxdepth", 5);
  if (depth < 0) params.fail("maxdepth must not be negative");
  if (const Param* regularize = params.find("regularize"); regularize && params.get_bool("regularize", false)) {
    diagnostics.warn(regularize->where, params.directive() + ": 'regularize' is ignored: materials stay as they are");
  }
  // A path of depth d, in the format's counting, has d vertices between its ends.
  scene.max_edges = static_cast<std::uint32_t>(depth) + 1;
}

}  // namespace bdpt_tool
