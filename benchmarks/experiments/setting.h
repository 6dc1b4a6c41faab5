// How large a run is, and where it reads and writes.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace bdpt_experiments {

// Tiny is for the tests: it shows that a row works, and measures nothing.
enum class Size { Full, Quick, Tiny };

struct Setting {
  Size size = Size::Full;
  std::uint32_t threads = 0;  // 0 = one per core
  std::string scenes;         // folder of Bitterli's scenes
  std::string output;         // folder of the results

  template <class T>
  T pick(T full, T quick, T tiny) const {
    return size == Size::Full ? full : size == Size::Quick ? quick : tiny;
  }
};

}  // namespace bdpt_experiments
