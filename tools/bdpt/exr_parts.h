// OpenEXR files of several parts.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "image.h"

namespace bdpt_tool {

// A file with a part of each name, all of one size and with the same layers: the first is the main one, too. `images`
// gives those of a part, asked for in order. The path holds the old file or the new one. An Error of kOutput if it
// cannot be written.
void write_exr_parts(const std::string& path, const std::vector<std::string>& parts,
                     const std::vector<std::string>& layers,
                     const std::function<std::vector<Image>(std::size_t part)>& images);

}  // namespace bdpt_tool
