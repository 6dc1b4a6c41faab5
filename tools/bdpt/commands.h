// The commands of the program. Each adds itself to the command line; it runs after all of that has been parsed.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "error.h"

namespace CLI {
class App;
}

namespace bdpt_tool {

using Command = std::function<ExitCode()>;

void add_render_command(CLI::App& app, Command& chosen);
void add_bake_command(CLI::App& app, Command& chosen);
void add_merge_command(CLI::App& app, Command& chosen);
void add_resolve_command(CLI::App& app, Command& chosen);
void add_compare_command(CLI::App& app, Command& chosen);
void add_info_command(CLI::App& app, Command& chosen);

// The whole program, but for main.
int run_program(int argc, char** argv);

}  // namespace bdpt_tool
