// SPDX-License-Identifier: Apache-2.0
#include "bake_atlas.h"

#include <algorithm>
#include <set>

namespace bdpt_tool {
namespace {

bool has_coordinates(const ShapeDescription& shape, int uv_set) {
  const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
  return mesh && !(uv_set == 0 ? mesh->uv : mesh->uv_lightmap).empty();
}

// Of several of one name, the second is NAME#2. In the name of a file a slash and the like are underscores.
void tell_apart(std::vector<Atlas>& atlases) {
  std::set<std::string> names, files;
  const auto unused = [](std::set<std::string>& taken, const std::string& name) {
    std::string other = name;
    for (int number = 2; !taken.insert(other).second; ++number) other = name + "#" + std::to_string(number);
    return other;
  };
  for (Atlas& atlas : atlases) {
    atlas.name = unused(names, atlas.name);
    std::string file = atlas.name;
    for (char& c : file)
      if (c == '/' || c == '\\' || c == ':') c = '_';
    atlas.file_name = unused(files, file);
  }
}

std::string list_of(const std::vector<Atlas>& atlases) {
  std::string text;
  for (const Atlas& atlas : atlases) text += (text.empty() ? "'" : ", '") + atlas.name + "'";
  return text;
}

}  // namespace

std::vector<Atlas> atlases_of(const SceneDescription& description, int uv_set, const std::vector<std::string>& names) {
  std::vector<Atlas> all;
  for (std::size_t i = 0; i < description.instances.size(); ++i) {
    const InstanceDescription& instance = description.instances[i];
    if (!has_coordinates(description.shapes[static_cast<std::size_t>(instance.shape)], uv_set)) continue;
    const bool more = !all.empty() && description.instances[all.back().instances[0]].node == instance.node;
    if (!more) all.push_back({instance.node_name, "", {}});
    all.back().instances.push_back(i);
  }
  tell_apart(all);
  if (all.empty()) {
    throw Error(Location{description.path, 0}, "no mesh has uv set " + std::to_string(uv_set) +
                                                   ", in which a lightmap could be laid out; try --uv " +
                                                   std::to_string(1 - uv_set));
  }
  if (names.empty()) return all;
  std::vector<Atlas> chosen;
  for (const std::string& name : names) {
    const auto known = std::find_if(all.begin(), all.end(), [&](const Atlas& a) { return a.name == name; });
    if (known == all.end())
      throw Error(ExitCode::kUsage, "--subset: '" + name + "' cannot be baked; there are " + list_of(all));
    chosen.push_back(*known);
  }
  return chosen;
}

std::vector<bdpt_lightmap_instance> lightmap_instances(const SceneDescription& description,
                                                       const std::vector<Atlas>& atlases, int uv_set) {
  std::vector<bdpt_lightmap_instance> result;
  for (std::size_t atlas = 0; atlas < atlases.size(); ++atlas)
    for (const std::size_t i : atlases[atlas].instances) {
      result.push_back(sized<bdpt_lightmap_instance>());
      result.back().atlas = static_cast<std::uint32_t>(atlas);
      result.back().instance = description.instances[i].id;
      result.back().uv_set = uv_set == 0 ? 1 : 0;
    }
  return result;
}

}  // namespace bdpt_tool
