// SPDX-License-Identifier: Apache-2.0
#include "pbrt/spectra.h"

#include <array>
#include <utility>

namespace bdpt_tool {
namespace {

struct Metal {
  const char* name;
  Rgb eta, k;
};

// Complex indices weighed to linear sRGB.
constexpr std::array<Metal, 4> kMetals = {{
    {"Ag", {0.155265f, 0.116723f, 0.138381f}, {4.828343f, 3.122225f, 2.147050f}},
    {"Al", {1.657460f, 0.880369f, 0.521229f}, {9.223870f, 6.269523f, 4.837001f}},
    {"Au", {0.143119f, 0.374957f, 1.442479f}, {3.983160f, 2.385721f, 1.603215f}},
    {"Cu", {0.200438f, 0.924033f, 1.102212f}, {3.912949f, 2.452848f, 2.142188f}},
}};

constexpr std::array<std::pair<const char*, float>, 7> kGlasses = {{
    {"glass-BK7", 1.5168f},
    {"glass-BAF10", 1.6700f},
    {"glass-FK51A", 1.4866f},
    {"glass-LASF9", 1.8503f},
    {"glass-SF5", 1.6727f},
    {"glass-SF10", 1.7283f},
    {"glass-SF11", 1.7847f},
}};

}  // namespace

std::optional<Rgb> named_metal(const std::string& name) {
  for (const Metal& metal : kMetals) {
    const std::string prefix = std::string("metal-") + metal.name;
    if (name == prefix + "-eta") return metal.eta;
    if (name == prefix + "-k") return metal.k;
  }
  return std::nullopt;
}

std::optional<float> named_glass(const std::string& name) {
  for (const auto& [glass, index] : kGlasses) {
    if (name == glass) return index;
  }
  return std::nullopt;
}

}  // namespace bdpt_tool
