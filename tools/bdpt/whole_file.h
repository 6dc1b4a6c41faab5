// Files that appear whole or not at all.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <functional>
#include <string>

namespace bdpt_tool {

// Writes beside the path and renames: it holds the old file or the new one. An Error of kOutput if it cannot be
// written, for whatever std::exception `write` throws, too.
void write_whole_file(const std::string& path, const std::function<void(std::ofstream&)>& write);

}  // namespace bdpt_tool
