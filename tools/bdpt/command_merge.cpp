// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>

#include "commands.h"
#include "film_output.h"
#include "output_path.h"

namespace bdpt_tool {
namespace {

struct MergeOptions {
  std::vector<std::string> films;
  std::string output;
};

ExitCode merge(const MergeOptions& options) {
  require_writable_file("--output", options.output);
  Diagnostics diagnostics;
  const Context context = make_context(1, diagnostics);
  const Film sum = load_film(context.get(), options.films.front());
  for (std::size_t i = 1; i < options.films.size(); ++i) {
    const Film film = load_film(context.get(), options.films[i]);
    check(bdpt_film_merge(sum.get(), film.get()), options.films[i]);
  }
  if (bdpt_film_save(sum.get(), options.output.c_str()) < 0) {
    throw Error(ExitCode::kOutput, "cannot write '" + options.output + "': " + bdpt_last_error());
  }
  return ExitCode::kSuccess;
}

}  // namespace

void add_merge_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("merge", "Add films of the same scene, options and seed, and other passes");
  const auto options = std::make_shared<MergeOptions>();
  command->add_option("films", options->films, "Two films or more")->required()->expected(2, 1 << 20);
  command->add_option("-o,--output", options->output, "The sum, a film")->required();
  command->callback([&chosen, options] { chosen = [options] { return merge(*options); }; });
}

}  // namespace bdpt_tool
