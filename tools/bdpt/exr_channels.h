// OpenEXR files of any channels.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bdpt.h"

namespace bdpt_tool {

struct ExrChannel {
  std::string name;
  const float* values;  // row 0 is the top
  std::size_t stride;   // floats from pixel to pixel
};

// 32-bit floats; `attributes` are texts of the header. The path holds the old file or the new one. An Error of kOutput
// if it cannot be written.
void write_exr_channels(const std::string& path, std::uint32_t width, std::uint32_t height,
                        const std::vector<ExrChannel>& channels, const std::map<std::string, std::string>& attributes,
                        const bdpt_chromaticities& chromaticities);

}  // namespace bdpt_tool
