// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>

#include "commands.h"
#include "film_output.h"
#include "image_metrics.h"
#include "json.h"
#include "output_path.h"

namespace bdpt_tool {
namespace {

struct CompareOptions {
  std::string a, b, diff;
  bool json = false;
};

Measured measure_film(const std::string& path) {
  Diagnostics diagnostics;
  const Context context = make_context(1, diagnostics);
  const Film film = load_film(context.get(), path);
  const bdpt_film_info info = film_info(film.get());
  Measured measured;
  measured.color = read_layer(film.get(), BDPT_LAYER_COLOR, false);
  if (info.relative_error >= 0) measured.variance = read_layer(film.get(), BDPT_LAYER_VARIANCE, false);
  measured.correlation = filter_correlation(info.filter, info.filter_radius);
  return measured;
}

Measured measure_exr(const std::string& path) {
  auto layers = read_exr(path, {path, 0});
  if (!layers.contains("")) throw Error(Location{path, 0}, "the image has no channels R, G and B");
  Measured measured;
  measured.color = std::move(layers.at(""));
  if (layers.contains("variance")) measured.variance = std::move(layers.at("variance"));
  return measured;
}

Measured measure(const std::string& path) {
  if (path.ends_with(".exr")) return measure_exr(path);
  if (path.ends_with(".film")) return measure_film(path);
  throw Error(ExitCode::kUsage, "'" + path + "' must end in .exr or .film");
}

void print_json(const Metrics& metrics) {
  JsonWriter json;
  json.value("mse", metrics.mse);
  json.value("relative_mse", metrics.relative_mse);
  json.array("mean_a", metrics.mean_a);
  json.array("mean_b", metrics.mean_b);
  json.array("bias_rgb", metrics.bias);
  json.value("bias", metrics.overall_bias);
  json.value("relative_bias", metrics.relative_bias);
  json.value("bias_standard_error", metrics.bias_error.value_or(NAN));
  json.value("bias_in_standard_errors",
             metrics.bias_error && *metrics.bias_error > 0 ? metrics.overall_bias / *metrics.bias_error : NAN);
  json.value("not_finite", metrics.not_finite);
  std::fputs(std::move(json).finish().c_str(), stdout);
}

void print_text(const Metrics& metrics) {
  std::printf("MSE            %.6g\n", metrics.mse);
  std::printf("relative MSE   %.6g\n", metrics.relative_mse);
  std::printf("mean A         %.6g %.6g %.6g\n", metrics.mean_a[0], metrics.mean_a[1], metrics.mean_a[2]);
  std::printf("mean B         %.6g %.6g %.6g\n", metrics.mean_b[0], metrics.mean_b[1], metrics.mean_b[2]);
  std::printf("bias A - B     %.6g (%.6g %.6g %.6g)\n", metrics.overall_bias, metrics.bias[0], metrics.bias[1],
              metrics.bias[2]);
  std::printf("relative bias  %.4f %%\n", 100 * metrics.relative_bias);
  if (metrics.bias_error) {
    std::printf("its error      %.6g, the bias is %.2f of these\n", *metrics.bias_error,
                *metrics.bias_error > 0 ? metrics.overall_bias / *metrics.bias_error : 0);
  } else {
    std::printf("its error      unknown: neither has a variance\n");
  }
  if (metrics.not_finite > 0) {
    std::printf("left out       %llu values that are not finite\n",
                static_cast<unsigned long long>(metrics.not_finite));
  }
}

ExitCode compare(const CompareOptions& options) {
  require_extension("--diff", options.diff, ".png");
  require_writable_file("--diff", options.diff);
  const Measured a = measure(options.a), b = measure(options.b);
  if (a.color.width != b.color.width || a.color.height != b.color.height) {
    const auto size = [](const Image& image) {
      return std::to_string(image.width) + "x" + std::to_string(image.height);
    };
    throw Error(ExitCode::kMismatch, "'" + options.a + "' has " + size(a.color) + " pixels and '" + options.b + "' " +
                                         size(b.color) + "; compare pictures of one size");
  }
  const Metrics metrics = compare_images(a, b);
  options.json ? print_json(metrics) : print_text(metrics);
  if (!options.diff.empty()) {
    const Image image = difference_image(a.color, b.color);
    if (bdpt_image_write_png(options.diff.c_str(), image.pixels.data(), image.width, image.height) < 0) {
      throw Error(ExitCode::kOutput, "cannot write '" + options.diff + "': " + bdpt_last_error());
    }
  }
  return ExitCode::kSuccess;
}

}  // namespace

void add_compare_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("compare", "Tell how far one picture or film is from another");
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("a", options->a, "An .exr or a .film")->required();
  command->add_option("b", options->b, "The reference, an .exr or a .film")->required();
  command->add_option("--diff", options->diff,
                      "Picture of the difference, PNG: red where A is brighter, blue where darker");
  command->add_flag("--json", options->json, "Print one JSON object instead of text");
  command->footer(
      "The relative MSE is the mean of (a - b)^2 / (b^2 + 0.01 M^2), M the mean of B. The error of the bias is the "
      "standard error that follows from the variance of a film, or from the layer 'variance' of an image; for an "
      "image, "
      "whose filter is not known, pixels are taken as independent, which makes it too small for wide filters. FLIP is "
      "not available.");
  command->callback([&chosen, options] { chosen = [options] { return compare(*options); }; });
}

}  // namespace bdpt_tool
