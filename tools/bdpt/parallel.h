// Work for all of the machine's threads.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace bdpt_tool {

// Calls body(0) to body(count - 1), in any order and on several threads at once. Of what they throw, the exception of
// the lowest index is thrown on.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace bdpt_tool
