// The colour space of a render: what --config and --working-space name.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace bdpt_tool {

struct ColorOptions {
  std::string config;         // an OpenColorIO configuration; empty = none
  std::string working_space;  // empty = linear Rec. 709
};

}  // namespace bdpt_tool
