// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "film_output.h"
#include "output_path.h"
#include "view_options.h"

namespace bdpt_tool {
namespace {

struct ResolveOptions {
  std::string film, output, png;
  ViewOptions view;
  ColorOptions color;
};

ExitCode resolve(ResolveOptions options) {
  check_color_options(options.color, options.view);
  exposure_of(options.view);  // refused before anything is written
  require_extension("--output", options.output, ".exr");
  require_extension("--png", options.png, ".png");
  require_writable_file("--output", options.output);
  require_writable_file("--png", options.png);
  Diagnostics diagnostics;
  const Context context = make_context(1, diagnostics, options.color);
  options.view.context = context.get();
  check_view(options.view);
  const Film film = load_film(context.get(), options.film);
  write_film_exr(options.output, film.get(), false, context.get());
  if (!options.png.empty()) write_png(options.png, read_layer(film.get(), BDPT_LAYER_COLOR, false), options.view);
  return ExitCode::kSuccess;
}

}  // namespace

void add_resolve_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("resolve", "Make a picture of a film");
  const auto options = std::make_shared<ResolveOptions>();
  command->add_option("film", options->film, "A film")->required();
  command->add_option("-o,--output", options->output, "The picture, OpenEXR, with a layer 'variance'")->required();
  command->add_option("--png", options->png, "The picture through the display transform, PNG");
  add_color_options(*command, options->color, options->view);
  command->callback([&chosen, options] { chosen = [options] { return resolve(*options); }; });
}

}  // namespace bdpt_tool
