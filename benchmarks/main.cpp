// Measures renders of a set of scenes and prints one table; see docs/performance.md.
//
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include "bdpt.h"
#include "geometry/embree.h"
#include "measure.h"
#include "options.h"
#include "report_json.h"
#include "report_table.h"

namespace {

using namespace bdpt_benchmark;

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string version_name(std::uint32_t version, std::uint32_t base) {
  return std::to_string(version / (base * base)) + "." + std::to_string(version / base % base) + "." +
         std::to_string(version % base);
}

std::string isa_name() {
  const bdpt::RayDevice device(bdpt::Isa::Best, std::make_shared<bdpt::MemoryMeter>(0));
  switch (device.isa()) {
    case bdpt::Isa::Avx512:
      return "AVX-512";
    case bdpt::Isa::Avx2:
      return "AVX2";
    default:
      return "SSE4.2";
  }
}

Setting setting(const Options& options) {
  return {processor_name(),
          isa_name(),
          version_name(bdpt::RayDevice::version(), 100),
          version_name(bdpt_version(), 256),
          std::thread::hardware_concurrency(),
          options.threads,
          options.quick};
}

int run(const Options& options) {
  bdpt_tool::Diagnostics diagnostics;
  Results results;
  results.setting = setting(options);
  for (const SceneFile& file : find_scenes(options.scenes))
    if (options.only.empty() || options.only == file.name)
      results.scenes.push_back(measure_scene(file, options, diagnostics));
  if (results.scenes.empty()) throw bdpt_tool::Error(bdpt_tool::ExitCode::kInput, "no scene is named " + options.only);
  std::fputs(table(results).c_str(), stdout);
  if (!options.json.empty()) {
    std::ofstream file(options.json);
    file << json(results) << std::flush;
    if (!file) throw bdpt_tool::Error(bdpt_tool::ExitCode::kOutput, options.json + ": cannot write");
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  int exit_code = 0;
  const auto options = parse_options(argc, argv, exit_code);
  if (!options) return exit_code;
  try {
    return run(*options);
  } catch (const bdpt_tool::Error& error) {
    std::fprintf(stderr, "bdpt_benchmark: %s\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bdpt_benchmark: %s\n", error.what());
    return 1;
  }
}
