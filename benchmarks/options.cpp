// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <CLI/CLI.hpp>

namespace bdpt_benchmark {

std::optional<Options> parse_options(int argc, char** argv, int& exit_code) {
  Options options;
  options.scenes = BDPT_BENCHMARK_SCENES;
  CLI::App app("Measures renders; prints a table, as Markdown.");
  app.add_option("--scenes", options.scenes, "folder of scenes; without it a scene that is built in")
      ->capture_default_str();
  app.add_option("--json", options.json, "file for the same figures as JSON");
  app.add_option("--only", options.only, "measure this scene alone");
  app.add_option("--threads", options.threads, "threads, compared with one")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_flag("--quick", options.quick, "images a quarter as large and half the seeds: coarser, in minutes");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error);
    return std::nullopt;
  }
  if (options.quick) {
    options.width = 128;
    options.rounds = 3;
    options.seeds = 4;
  }
  return options;
}

}  // namespace bdpt_benchmark
