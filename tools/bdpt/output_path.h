// Checks before the work that its results can be written.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace bdpt_tool {

// The folder of `path` must exist and be writable, `path` itself must be no folder. `option` names it in the error.
void require_writable_file(const std::string& option, const std::string& path);

// Makes the folder if it is not there, and checks that files can be made in it.
void require_writable_folder(const std::string& option, const std::string& path);

void require_extension(const std::string& option, const std::string& path, const std::string& extension);

}  // namespace bdpt_tool
