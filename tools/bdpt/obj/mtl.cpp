// SPDX-License-Identifier: Apache-2.0
#include "obj/mtl.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "file_data.h"
#include "obj/text_lines.h"

namespace bdpt_tool::obj {
namespace {

// What follows the options of a map, such as -bm 0.5; `scale` receives that.
std::string_view file_of(std::string_view rest, const Location& where, float& scale) {
  while (rest.starts_with('-')) {
    const auto word = [&] {
      const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
      const std::string_view first = rest.substr(0, end);
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t", end), rest.size()));
      return first;
    };
    const std::string_view option = word();
    if (option == "-bm") {
      scale = number(word(), where);
      continue;
    }
    int values = 1;
    if (option == "-mm") values = 2;
    const bool triple = option == "-o" || option == "-s" || option == "-t";
    if (triple)
      throw Error(where, "the option " + std::string(option) + " of a map is not known; change the mesh's vt");
    while (values-- > 0) word();
  }
  return rest;
}

Rgb color_of(const Line& line) {
  if (line.rest.starts_with("spectral") || line.rest.starts_with("xyz")) {
    throw Error(line.where, "'" + std::string(line.keyword) + "' must be three numbers, of RGB");
  }
  const std::vector<float> n = numbers(line, 1);
  if (n.size() == 2) throw Error(line.where, "'" + std::string(line.keyword) + "' needs one number, or three");
  const Rgb color = n.size() == 1 ? Rgb{n[0], n[0], n[0]} : Rgb{n[0], n[1], n[2]};
  for (const float x : color) {
    if (x < 0) throw Error(line.where, "'" + std::string(line.keyword) + "' must not be negative");
  }
  return color;
}

bool is_black(const Rgb& color) { return color == Rgb{0, 0, 0}; }

// The gloss reflects Ks at normal incidence: an index that reflects its largest channel, and what is left for the
// others.
void set_gloss(const Rgb& specular, MaterialDescription& to) {
  constexpr float kMaxReflected = 0.66f;  // by the library's largest index
  const float largest = std::max({specular[0], specular[1], specular[2]});
  if (!(largest > 0)) return;
  const float root = std::sqrt(std::min(largest, kMaxReflected));
  to.ior = (1 + root) / (1 - root);
  for (std::size_t c = 0; c < 3; ++c) to.principled.specular_color.factor[c] = specular[c] / largest;
}

// Glass that colours what passes by Tf.
void make_filter(const Rgb& filter, MaterialDescription& to) {
  to.type = BDPT_MATERIAL_PRINCIPLED;
  to.reflectance = filter;
  to.reflectance_texture = {};
  to.principled.transmission.factor = 1;
  to.principled.thickness.factor = 1;
  to.principled.roughness.factor = 0;
}

}  // namespace

struct MaterialLibrary::Entry {
  MaterialDescription material;
  Rgb diffuse = {0.8f, 0.8f, 0.8f}, specular = {}, filter = {1, 1, 1};
  float exponent = 0;
  int illumination = 2;
};

void MaterialLibrary::read(const std::string& path, const Location& from) {
  const FileData file(path, from);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  subfolder_ = folder.lexically_relative(std::filesystem::path(from.file).parent_path()).string();
  parse(decoded(file.text(), path), path);
}

int MaterialLibrary::find(const std::string& name) const {
  const auto found = materials_.find(name);
  return found == materials_.end() ? -1 : found->second;
}

void MaterialLibrary::parse(const std::string& text, const std::string& path) {
  LineReader lines(text, path);
  std::optional<Entry> entry;
  while (const std::optional<Line> line = lines.next()) {
    if (line->keyword == "newmtl") {
      if (entry) finish(*entry);
      entry.emplace();
      entry->material.label = line->rest;
      entry->material.where = line->where;
    } else if (!entry) {
      throw Error(line->where, "'" + std::string(line->keyword) + "' before the first newmtl");
    } else {
      set(*line, *entry);
    }
  }
  if (entry) finish(*entry);
}

void MaterialLibrary::set(const Line& line, Entry& entry) {
  MaterialDescription& material = entry.material;
  std::string keyword(line.keyword);
  std::transform(keyword.begin(), keyword.end(), keyword.begin(), [](unsigned char c) { return std::tolower(c); });
  if (keyword == "kd") {
    entry.diffuse = color_of(line);
  } else if (keyword == "ks") {
    entry.specular = color_of(line);
  } else if (keyword == "ke") {
    material.emission = color_of(line);
  } else if (keyword == "tf") {
    entry.filter = color_of(line);
  } else if (keyword == "ns") {
    entry.exponent = numbers(line, 1)[0];
  } else if (keyword == "ni") {
    material.ior = numbers(line, 1)[0];
  } else if (keyword == "d") {
    material.alpha.factor = numbers(line, 1)[0];
  } else if (keyword == "tr") {
    material.alpha.factor = 1 - numbers(line, 1)[0];
  } else if (keyword == "illum") {
    entry.illumination = static_cast<int>(numbers(line, 1)[0]);
  } else if (keyword == "map_kd") {
    set_map(line, true, material.reflectance_texture);
  } else if (keyword == "map_ke") {
    set_map(line, true, material.emission_texture);
  } else if (keyword == "map_d") {
    set_map(line, false, material.alpha.texture);
    material.alpha.channel = 0;
  } else if (keyword == "map_bump" || keyword == "bump") {
    set_map(line, false, material.bump.texture);
    float scale = 1;
    file_of(line.rest, line.where, scale);
    material.bump.factor = scale;
  } else if (keyword == "norm" || keyword == "map_kn") {
    set_map(line, false, material.normal.texture);
  } else if (keyword != "ka" && keyword != "map_ka") {
    notes_.add("'" + std::string(line.keyword) + "' of MTL is left out", material.label);
  }
}

void MaterialLibrary::set_map(const Line& line, bool is_color, TextureUse& use) {
  float scale = 1;
  std::string file(file_of(line.rest, line.where, scale));
  std::replace(file.begin(), file.end(), '\\', '/');
  const std::string path = folder_.path_of((std::filesystem::path(subfolder_) / file).string(), line.where);
  const auto [found, added] = textures_.emplace(std::pair(path, is_color), static_cast<int>(scene_.textures.size()));
  if (added) {
    TextureDescription texture;
    texture.label = std::filesystem::path(path).filename().string();
    texture.where = line.where;
    texture.image = read_image(path, line.where);
    texture.exponent = is_color ? 0 : 1;
    scene_.textures.push_back(std::move(texture));
  }
  use.texture = found->second;
}

void MaterialLibrary::finish(Entry& entry) {
  MaterialDescription& to = entry.material;
  const int illumination = entry.illumination;
  if (illumination == 5 || (illumination == 3 && is_black(entry.diffuse))) {
    to.type = BDPT_MATERIAL_MIRROR;
    to.reflectance = entry.specular;
    to.reflectance_texture = {};
  } else if (illumination == 4 || illumination == 6 || illumination == 7 || illumination == 9) {
    to.type = BDPT_MATERIAL_DIELECTRIC;
    if (!(to.ior >= 1)) to.ior = 1.5f;
    if (entry.filter != Rgb{1, 1, 1}) make_filter(entry.filter, to);
    to.alpha.factor = 1;  // what they let through is said by the glass
  } else {
    // Phong's exponent n and Blinn's: alpha of a microfacet lobe of the same width is sqrt(2 / (n + 2)).
    to.type = BDPT_MATERIAL_PRINCIPLED;
    to.reflectance = to.reflectance_texture.texture >= 0 && is_black(entry.diffuse) ? Rgb{1, 1, 1} : entry.diffuse;
    to.principled.roughness.factor = std::pow(2 / (std::max(entry.exponent, 0.0f) + 2), 0.25f);
    set_gloss(entry.specular, to);
    if (is_black(entry.specular) || illumination < 2) to.type = BDPT_MATERIAL_DIFFUSE;
  }
  for (float& x : to.reflectance) {
    if (x > 1) notes_.add("a reflectance above 1 becomes 1", to.label);
    x = std::min(x, 1.0f);
  }
  if (!(to.alpha.factor >= 0 && to.alpha.factor <= 1)) throw Error(to.where, "d and Tr must be between 0 and 1");
  if (to.alpha.factor < 1 || to.alpha.texture.texture >= 0) to.alpha_mode = AlphaMode::kBlend;
  if (!materials_.emplace(to.label, static_cast<int>(scene_.materials.size())).second) {
    notes_.add("of materials with one name the first is used", to.label);
    return;
  }
  scene_.materials.push_back(std::move(to));
}

}  // namespace bdpt_tool::obj
