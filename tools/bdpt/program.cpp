// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <new>

#include "bdpt.h"
#include "commands.h"

namespace bdpt_tool {
namespace {

std::string version_text() {
  const std::uint32_t version = bdpt_version();
  return "bdpt " + std::to_string(version >> 16) + "." + std::to_string(version >> 8 & 255) + "." +
         std::to_string(version & 255);
}

int report(const std::string& text, ExitCode code) {
  std::fprintf(stderr, "bdpt: %s\n", text.c_str());
  return static_cast<int>(code);
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Bidirectional path tracing: renders scenes, bakes lightmaps, and works with the films it makes.",
               "bdpt");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.footer(kExitCodeHelp);
  Command chosen;
  add_render_command(app, chosen);
  add_bake_command(app, chosen);
  add_merge_command(app, chosen);
  add_resolve_command(app, chosen);
  add_compare_command(app, chosen);
  add_info_command(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    return report(std::string(error.what()) + "; see bdpt --help", ExitCode::kUsage);
  }
  return static_cast<int>(chosen());
}

}  // namespace

int run_program(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const Error& error) {
    return report(error.what(), error.code());
  } catch (const std::bad_alloc&) {
    return report("out of memory; close other programs, or make the image or the scene smaller", ExitCode::kFailure);
  } catch (const std::exception& error) {
    return report(error.what(), ExitCode::kFailure);
  }
}

}  // namespace bdpt_tool
