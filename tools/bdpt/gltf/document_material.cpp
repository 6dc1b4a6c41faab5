// Materials: what the core of the format says, and each extension. The defaults are those of PrincipledDescription.
//
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <fstream>  // for tinygltf, which forgets it

#include "gltf/tinygltf.h"
#include "scene_description.h"

namespace bdpt_tool::gltf {
namespace {

using Object = tinygltf::Value;

const Object* member(const Object& object, const char* name) {
  return object.IsObject() && object.Has(name) ? &object.Get(name) : nullptr;
}

void read(const Object& object, const char* name, float& to) {
  if (const Object* value = member(object, name)) to = static_cast<float>(value->GetNumberAsDouble());
}

template <class Numbers>
void read_all(const Object& object, const char* name, Numbers& to) {
  const Object* values = member(object, name);
  for (std::size_t i = 0; values && i < to.size(); ++i) {
    to[i] = static_cast<typename Numbers::value_type>(values->Get(static_cast<int>(i)).GetNumberAsDouble());
  }
}

// The format's v runs down, the mesh's runs up: what is u' = a u + b v + c there is a u - b v + (b + c) here.
std::array<float, 6> turned_up(const std::array<double, 6>& m) {
  const auto [a, b, c, d, e, f] = m;
  const std::array<double, 6> up = {a, -b, b + c, -d, e, 1 - e - f};
  std::array<float, 6> result;
  for (std::size_t i = 0; i < 6; ++i) result[i] = static_cast<float>(up[i]);
  return result;
}

void read_transform(const Object& transform, TextureUse& to) {
  std::array<double, 2> offset = {0, 0}, scale = {1, 1};
  read_all(transform, "offset", offset);
  read_all(transform, "scale", scale);
  const Object* rotation = member(transform, "rotation");
  const double angle = rotation ? rotation->GetNumberAsDouble() : 0, c = std::cos(angle), s = std::sin(angle);
  to.transform = turned_up({c * scale[0], s * scale[1], offset[0], -s * scale[0], c * scale[1], offset[1]});
  if (const Object* set = member(transform, "texCoord")) to.uv_set = set->GetNumberAsInt();
}

// Of a TextureInfo, a NormalTextureInfo or an OcclusionTextureInfo.
template <class Info>
TextureUse use_of(const Info& info) {
  TextureUse to;
  to.texture = info.index;
  to.uv_set = info.texCoord;
  if (const Object* transform = extension(info.extensions, "KHR_texture_transform")) read_transform(*transform, to);
  return to;
}

void read(const Object& object, const char* name, TextureUse& to) {
  const Object* info = member(object, name);
  if (!info) return;
  to.texture = info->Get("index").GetNumberAsInt();
  if (const Object* set = member(*info, "texCoord")) to.uv_set = set->GetNumberAsInt();
  const Object* extensions = member(*info, "extensions");
  const Object* transform = extensions ? member(*extensions, "KHR_texture_transform") : nullptr;
  if (transform) read_transform(*transform, to);
}

void read(const Object& object, const char* factor, const char* texture, FloatValue& to) {
  read(object, factor, to.factor);
  read(object, texture, to.texture);
}

void read(const Object& object, const char* factor, const char* texture, ColorValue& to) {
  read_all(object, factor, to.factor);
  read(object, texture, to.texture);
}

void read_volume(const Object& volume, PrincipledDescription& to) {
  read(volume, "thicknessFactor", "thicknessTexture", to.thickness);
  read(volume, "attenuationDistance", to.attenuation_distance);
  read_all(volume, "attenuationColor", to.attenuation_color);
}

void read_clearcoat(const Object& coat, PrincipledDescription& to) {
  read(coat, "clearcoatFactor", "clearcoatTexture", to.clearcoat);
  read(coat, "clearcoatRoughnessFactor", "clearcoatRoughnessTexture", to.clearcoat_roughness);
  read(coat, "clearcoatNormalTexture", to.clearcoat_normal.texture);
  if (const Object* map = member(coat, "clearcoatNormalTexture")) read(*map, "scale", to.clearcoat_normal.factor);
}

void read_iridescence(const Object& film, PrincipledDescription& to) {
  read(film, "iridescenceFactor", "iridescenceTexture", to.iridescence);
  read(film, "iridescenceIor", to.iridescence_ior);
  read(film, "iridescenceThicknessMinimum", to.iridescence_thickness_min);
  read(film, "iridescenceThicknessMaximum", "iridescenceThicknessTexture", to.iridescence_thickness);
}

void read_extensions(const tinygltf::ExtensionMap& extensions, MaterialDescription& material) {
  PrincipledDescription& to = material.principled;
  material.unlit = extension(extensions, "KHR_materials_unlit") != nullptr;
  if (const Object* ior = extension(extensions, "KHR_materials_ior")) read(*ior, "ior", material.ior);
  if (const Object* e = extension(extensions, "KHR_materials_transmission")) {
    read(*e, "transmissionFactor", "transmissionTexture", to.transmission);
  }
  if (const Object* e = extension(extensions, "KHR_materials_volume")) read_volume(*e, to);
  if (const Object* e = extension(extensions, "KHR_materials_dispersion")) read(*e, "dispersion", to.dispersion);
  if (const Object* e = extension(extensions, "KHR_materials_clearcoat")) read_clearcoat(*e, to);
  if (const Object* e = extension(extensions, "KHR_materials_sheen")) {
    read(*e, "sheenColorFactor", "sheenColorTexture", to.sheen_color);
    read(*e, "sheenRoughnessFactor", "sheenRoughnessTexture", to.sheen_roughness);
  }
  if (const Object* e = extension(extensions, "KHR_materials_specular")) {
    read(*e, "specularFactor", "specularTexture", to.specular);
    read(*e, "specularColorFactor", "specularColorTexture", to.specular_color);
  }
  if (const Object* e = extension(extensions, "KHR_materials_iridescence")) read_iridescence(*e, to);
  if (const Object* e = extension(extensions, "KHR_materials_anisotropy")) {
    read(*e, "anisotropyStrength", "anisotropyTexture", to.anisotropy);
    read(*e, "anisotropyRotation", to.anisotropy_rotation);
  }
}

void read_emission(const tinygltf::Material& from, MaterialDescription& to) {
  float strength = 1;
  if (const Object* e = extension(from.extensions, "KHR_materials_emissive_strength")) {
    read(*e, "emissiveStrength", strength);
  }
  for (std::size_t c = 0; c < 3; ++c) to.emission[c] = static_cast<float>(from.emissiveFactor[c]) * strength;
  to.emission_texture = use_of(from.emissiveTexture);
  to.emission_two_sided = from.doubleSided;
}

// An unlit material looks as it is by its base colour alone.
void make_unlit(MaterialDescription& to) {
  to.emission = to.reflectance;
  to.emission_texture = to.reflectance_texture;
}

}  // namespace

MaterialDescription read_material(const tinygltf::Material& from) {
  const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
  MaterialDescription to;
  to.type = BDPT_MATERIAL_PRINCIPLED;
  to.label = from.name;
  for (std::size_t c = 0; c < 3; ++c) to.reflectance[c] = static_cast<float>(pbr.baseColorFactor[c]);
  to.reflectance_texture = use_of(pbr.baseColorTexture);
  to.principled.metallic.factor = static_cast<float>(pbr.metallicFactor);
  to.principled.roughness.factor = static_cast<float>(pbr.roughnessFactor);
  to.principled.metallic.texture = to.principled.roughness.texture = use_of(pbr.metallicRoughnessTexture);
  to.one_sided = !from.doubleSided;
  if (from.alphaMode == "MASK") to.alpha_mode = AlphaMode::kMask;
  if (from.alphaMode == "BLEND") to.alpha_mode = AlphaMode::kBlend;
  to.alpha_cutoff = static_cast<float>(from.alphaCutoff);
  to.alpha.factor = static_cast<float>(pbr.baseColorFactor[3]);
  to.alpha.texture = to.reflectance_texture;
  to.normal.texture = use_of(from.normalTexture);
  to.normal.factor = static_cast<float>(from.normalTexture.scale);
  read_emission(from, to);
  read_extensions(from.extensions, to);
  if (to.unlit) make_unlit(to);
  return to;
}

}  // namespace bdpt_tool::gltf
