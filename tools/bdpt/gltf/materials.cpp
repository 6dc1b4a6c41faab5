// SPDX-License-Identifier: Apache-2.0
#include "gltf/materials.h"

#include <algorithm>
#include <cmath>

namespace bdpt_tool::gltf {
namespace {

// Below the first a surface is smooth; the second is how close to 1 a reflectance by a complex index comes.
constexpr double kSmoothAlpha = 1e-3, kMaxReflectance = 0.9999;
constexpr double kMinIor = 1, kMaxIor = 10, kDefaultIor = 1.5;

Rgb rgb(const std::array<double, 3>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

// The format's roughness is the square root of GGX's alpha.
std::array<float, 2> ggx_alpha(double roughness) {
  const double alpha = roughness * roughness;
  if (alpha < kSmoothAlpha) return {0, 0};
  return {static_cast<float>(alpha), static_cast<float>(alpha)};
}

void multiply(bdpt_tool::Image& image, const Rgb& factor) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] *= factor[i % 3];
}

}  // namespace

int MaterialTable::use(int material) {
  const std::size_t slot = material < 0 ? converted_.size() - 1 : static_cast<std::size_t>(material);
  int& index = converted_[slot];
  if (index < 0) {
    MaterialDescription converted =
        material < 0 ? convert(Material(), "the default material")
                     : convert(document_.materials[slot], place("materials", slot, document_.materials[slot].name));
    index = static_cast<int>(scene_.materials.size());
    scene_.materials.push_back(std::move(converted));
  }
  return index;
}

MaterialDescription MaterialTable::convert(const Material& from, const std::string& where) {
  MaterialDescription to;
  to.label = from.name.empty() ? where : from.name;
  to.where = {scene_.path, 0};
  const bool textured = from.base_color_texture.texture >= 0 || from.has_metallic_roughness_texture;
  if (from.transmission >= 0.5) {
    set_dielectric(from, where, to);
  } else if (from.metallic == 1 && !textured && !from.unlit) {
    set_conductor(from, to);
  } else {
    set_diffuse(from, where, to);
  }
  to.one_sided = !from.double_sided && to.type != BDPT_MATERIAL_DIELECTRIC;
  set_emission(from, where, to);
  note_what_is_left_out(from, where);
  return to;
}

// The index with eta = 1 whose reflectance at normal incidence is the base colour.
void MaterialTable::set_conductor(const Material& from, MaterialDescription& to) {
  to.type = BDPT_MATERIAL_CONDUCTOR;
  for (std::size_t c = 0; c < 3; ++c) {
    const double r = std::min(from.base_color[c], kMaxReflectance);
    to.eta[c] = 1;
    to.k[c] = static_cast<float>(2 * std::sqrt(r) / std::sqrt(1 - r));
  }
  to.roughness = ggx_alpha(from.roughness);
}

void MaterialTable::set_dielectric(const Material& from, const std::string& where, MaterialDescription& to) {
  to.type = BDPT_MATERIAL_DIELECTRIC;
  double ior = from.ior.value_or(kDefaultIor);
  if (!(ior >= kMinIor && ior <= kMaxIor)) {
    notes_.add("an index of refraction outside [1, 10] becomes 1.5", where);
    ior = kDefaultIor;
  }
  to.ior = static_cast<float>(ior);
  to.roughness = ggx_alpha(from.roughness);
  if (from.transmission < 1) notes_.add("transmission of half and more is taken as whole", where);
  if (from.has_transmission_texture) notes_.add("textures of transmission are left out", where);
  if (!from.has_volume) notes_.add("thin-walled transmission is taken as solid glass, which refracts", where);
  if (from.has_volume) notes_.add("absorption in a volume is left out", where);
  const bool white = from.base_color[0] == 1 && from.base_color[1] == 1 && from.base_color[2] == 1;
  if (!white || from.base_color_texture.texture >= 0) notes_.add("glass has no base colour", where);
  if (from.has_metallic_roughness_texture) notes_.add("textures of metalness and roughness are left out", where);
}

void MaterialTable::set_diffuse(const Material& from, const std::string& where, MaterialDescription& to) {
  to.type = BDPT_MATERIAL_DIFFUSE;
  to.reflectance = rgb({from.base_color[0], from.base_color[1], from.base_color[2]});
  if (from.base_color_texture.texture >= 0) {
    to.texture = reflectance_texture(from.base_color_texture.texture, to.reflectance);
    to.reflectance = {1, 1, 1};
  }
  if (from.transmission > 0) notes_.add("transmission of less than half is left out", where);
  if (from.unlit) {
    notes_.add("unlit materials are taken as diffuse", where);
  } else if (from.has_metallic_roughness_texture && from.metallic > 0) {
    notes_.add("materials whose metalness is a texture are taken as diffuse", where);
  } else if (from.metallic > 0) {
    notes_.add("metals of textured colour, and half metals, are taken as diffuse", where);
  } else {
    notes_.add("materials that are no metal are taken as diffuse, without the gloss on top", where);
  }
}

void MaterialTable::set_emission(const Material& from, const std::string& where, MaterialDescription& to) {
  to.emission = rgb(from.emissive);
  to.emission_two_sided = from.double_sided;
  if (from.emissive_texture < 0 || !to.emits()) return;
  notes_.add("a texture of emission becomes its mean", where);
  const Rgb mean = mean_of(from.emissive_texture);
  for (std::size_t c = 0; c < 3; ++c) to.emission[c] *= mean[c];
}

void MaterialTable::note_what_is_left_out(const Material& from, const std::string& where) {
  if (from.has_normal_texture) notes_.add("normal maps are left out", where);
  if (from.has_occlusion_texture) notes_.add("occlusion maps are left out: light is traced", where);
  if (!from.opaque) notes_.add("alpha is left out: all is opaque", where);
}

ByteImage MaterialTable::read_image(int texture) const {
  const auto slot = static_cast<std::size_t>(texture);
  const Location where{scene_.path, 0};
  const int source = document_.textures[slot].image;
  if (source < 0) throw Error(where, place("textures", slot) + " has no image in PNG or JPEG; add one");
  const Image& image = document_.images[static_cast<std::size_t>(source)];
  if (!image.path.empty()) return read_byte_image(image.path, where);
  const std::string_view data(reinterpret_cast<const char*>(image.data), image.size);
  return decode_byte_image(place("images", static_cast<std::size_t>(source), image.name), data, where);
}

int MaterialTable::reflectance_texture(int texture, const Rgb& factor) {
  const Texture& from = document_.textures[static_cast<std::size_t>(texture)];
  const std::string where = place("textures", static_cast<std::size_t>(texture));
  const auto [found, added] =
      textures_.emplace(std::tuple(from.image, factor), static_cast<int>(scene_.textures.size()));
  if (!added) return found->second;
  if (!from.repeats) notes_.add("textures are repeated, neither clamped nor mirrored", where);
  if (from.nearest) notes_.add("textures are filtered bilinearly", where);
  TextureDescription to;
  to.where = {scene_.path, 0};
  ByteImage bytes = read_image(texture);
  const Image& image = document_.images[static_cast<std::size_t>(from.image)];
  to.label = place("images", static_cast<std::size_t>(from.image), image.name);
  if (factor == Rgb{1, 1, 1}) {
    to.image = std::move(bytes);
  } else {
    bdpt_tool::Image linear = to_linear(bytes);
    multiply(linear, factor);
    to.image = std::move(linear);
  }
  scene_.textures.push_back(std::move(to));
  return found->second;
}

Rgb MaterialTable::mean_of(int texture) {
  const int image = document_.textures[static_cast<std::size_t>(texture)].image;
  if (const auto found = means_.find(image); found != means_.end()) return found->second;
  const bdpt_tool::Image linear = to_linear(read_image(texture));
  std::array<double, 3> sum = {};
  for (std::size_t i = 0; i < linear.pixels.size(); ++i) sum[i % 3] += linear.pixels[i];
  const double texels = static_cast<double>(linear.width) * linear.height;
  return means_[image] = rgb({sum[0] / texels, sum[1] / texels, sum[2] / texels});
}

}  // namespace bdpt_tool::gltf
