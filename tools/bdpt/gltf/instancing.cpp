// SPDX-License-Identifier: Apache-2.0
#include "gltf/instancing.h"

#include <algorithm>

#include "gltf/accessor.h"
#include "gltf/nodes.h"

namespace bdpt_tool::gltf {
namespace {

// An attribute of so many numbers to a copy; none if it is not there.
template <std::size_t N>
std::vector<std::array<double, N>> attribute(const Document& document, const Node& node, const char* name,
                                             const Location& where, const std::string& place) {
  const auto found = node.instancing.find(name);
  if (found == node.instancing.end()) return {};
  const std::vector<float> values = read_floats(document.accessors[static_cast<std::size_t>(found->second)],
                                                static_cast<int>(N), where, place + " " + name);
  std::vector<std::array<double, N>> result(values.size() / N);
  for (std::size_t i = 0; i < values.size(); ++i) result[i / N][i % N] = static_cast<double>(values[i]);
  return result;
}

}  // namespace

std::vector<Transform> copies_of(const Document& document, const Node& node, const Location& where,
                                 const std::string& place) {
  const auto translations = attribute<3>(document, node, "TRANSLATION", where, place);
  const auto rotations = attribute<4>(document, node, "ROTATION", where, place);
  const auto scales = attribute<3>(document, node, "SCALE", where, place);
  const std::size_t count = std::max({translations.size(), rotations.size(), scales.size()});
  for (const std::size_t other : {translations.size(), rotations.size(), scales.size()}) {
    if (other != 0 && other != count) {
      throw Error(where, place + ": EXT_mesh_gpu_instancing has attributes of different lengths");
    }
  }
  std::vector<Transform> copies(std::max<std::size_t>(count, 1));
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<double, 4> rotation = rotations.empty() ? std::array<double, 4>{0, 0, 0, 1} : rotations[i];
    if (rotation == std::array<double, 4>{}) throw Error(where, place + " ROTATION: one has the length zero");
    copies[i] = compose(translations.empty() ? std::array<double, 3>{0, 0, 0} : translations[i], rotation,
                        scales.empty() ? std::array<double, 3>{1, 1, 1} : scales[i]);
  }
  return copies;
}

}  // namespace bdpt_tool::gltf
