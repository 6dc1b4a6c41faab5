// How the benchmark is run.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace bdpt_benchmark {

struct Options {
  std::string scenes;  // folder
  std::string json;    // file; empty = none
  std::string only;    // name of a scene; empty = all
  bool quick = false;

  std::uint32_t threads = 2;  // what is compared with one thread
  std::uint32_t width = 256;  // of the images
  int rounds = 5;             // of alternating measurements
  int warm_passes = 1;        // before each of them
  int timed_passes = 2;
  int seeds = 8;             // independent renders for the variance
  int variance_passes = 16;  // samples per pixel of each
};

// Empty when the command line asked for help or is wrong; exit_code then says how to end.
std::optional<Options> parse_options(int argc, char** argv, int& exit_code);

}  // namespace bdpt_benchmark
