// SPDX-License-Identifier: Apache-2.0
#include "pbrt/materials.h"

#include <algorithm>
#include <cmath>

#include "pbrt/spectra.h"

namespace bdpt_tool {
namespace {

// Below this, pbrt treats a surface as smooth; above, no axis goes below the second number.
constexpr float kSmoothAlpha = 1e-3f;
constexpr float kLeastAlpha = 1e-4f;

float constant_float(const ParamList& params, const std::string& name, float fallback, TextureTable& textures) {
  const std::string texture = params.get_texture(name);
  if (texture.empty()) return params.get_float(name, fallback);
  const TextureValue value = textures.resolve(texture, params);
  if (value.texture >= 0) params.fail(*params.find(name), "cannot be an image yet; give one number");
  return value.constant[0];
}

std::array<float, 2> roughness(const ParamList& params, TextureTable& textures) {
  const float both = constant_float(params, "roughness", 0, textures);
  std::array<float, 2> alpha = {constant_float(params, "uroughness", both, textures),
                                constant_float(params, "vroughness", both, textures)};
  const bool remap = params.get_bool("remaproughness", true);
  for (float& a : alpha) {
    if (a < 0) params.fail("a roughness below zero");
    if (remap) a = std::sqrt(a);
    if (a > 1) params.fail("a roughness above 1 is not known; use 1");
  }
  if (std::max(alpha[0], alpha[1]) < kSmoothAlpha) return {0, 0};
  return {std::max(alpha[0], kLeastAlpha), std::max(alpha[1], kLeastAlpha)};
}

void diffuse(const ParamList& params, TextureTable& textures, MaterialDescription& material) {
  material.type = BDPT_MATERIAL_DIFFUSE;
  const std::string texture = params.get_texture("reflectance");
  if (texture.empty()) {
    material.reflectance = params.get_rgb("reflectance", {0.5f, 0.5f, 0.5f});
  } else {
    const TextureValue value = textures.resolve(texture, params);
    material.reflectance = value.constant;
    material.texture = value.texture;
  }
  for (float& x : material.reflectance) x = std::clamp(x, 0.0f, 1.0f);
}

// A complex index, part by part: rgb, a constant spectrum, or a metal by name.
Rgb index_part(const ParamList& params, const std::string& name, const std::string& fallback) {
  const Param* param = params.find(name);
  if (!param) return *named_metal(fallback);
  if (param->type == "texture") params.fail(*param, "cannot be a texture; give it as rgb");
  if (param->type == "spectrum" && !param->strings.empty()) {
    const auto metal = named_metal(param->strings[0]);
    if (!metal) {
      params.fail(*param, "names the spectrum '" + param->strings[0] +
                              "', which is not known; give it as rgb. Known: metal-{Ag,Al,Au,Cu}-{eta,k}");
    }
    return *metal;
  }
  return params.get_rgb(name, {});
}

void conductor(const ParamList& params, TextureTable& textures, MaterialDescription& material) {
  material.type = BDPT_MATERIAL_CONDUCTOR;
  if (const Param* param = params.find("reflectance")) {
    if (params.has("eta") || params.has("k")) params.fail(*param, "and eta or k exclude each other");
    if (param->type == "texture") params.fail(*param, "cannot be a texture yet; give it as rgb");
    // The index with eta = 1 that has this reflectance at normal incidence.
    const Rgb reflectance = params.get_rgb("reflectance", {});
    for (int c = 0; c < 3; ++c) {
      const float r = std::clamp(reflectance[c], 0.0f, 0.9999f);
      material.eta[c] = 1;
      material.k[c] = 2 * std::sqrt(r) / std::sqrt(1 - r);
    }
  } else {
    material.eta = index_part(params, "eta", "metal-Cu-eta");
    material.k = index_part(params, "k", "metal-Cu-k");
  }
  for (int c = 0; c < 3; ++c) {
    if (material.eta[c] < 0 || material.k[c] < 0) params.fail("eta and k must not be negative");
  }
  material.roughness = roughness(params, textures);
}

float dielectric_index(const ParamList& params, Diagnostics& diagnostics) {
  const Param* param = params.find("eta");
  if (!param) return 1.5f;
  if (param->type == "float") return params.get_float("eta", 1.5f);
  if (param->type == "spectrum" && !param->strings.empty()) {
    const auto index = named_glass(param->strings[0]);
    if (!index) {
      params.fail(*param, "names the glass '" + param->strings[0] + "', which is not known; give \"float eta\"");
    }
    diagnostics.warn(param->where, params.directive() + ": this program works in RGB, the glass does not disperse");
    return *index;
  }
  const Rgb eta = params.get_rgb("eta", {});
  if (eta[0] != eta[1] || eta[1] != eta[2]) params.fail(*param, "must be one number; give \"float eta\"");
  return eta[0];
}

void dielectric(const ParamList& params, TextureTable& textures, Diagnostics& diagnostics,
                MaterialDescription& material) {
  material.type = BDPT_MATERIAL_DIELECTRIC;
  material.ior = dielectric_index(params, diagnostics);
  if (!(material.ior >= 0.1f && material.ior <= 10)) params.fail("eta must be between 0.1 and 10");
  material.roughness = roughness(params, textures);
}

}  // namespace

MaterialDescription convert_material(const std::string& type, const ParamList& params, TextureTable& textures,
                                     Diagnostics& diagnostics) {
  MaterialDescription material;
  material.where = params.where();
  params.refuse("displacement", "is not known yet; remove it, or displace the mesh");
  params.refuse("normalmap", "is not known yet; remove it");
  if (type == "diffuse") {
    diffuse(params, textures, material);
  } else if (type == "conductor") {
    conductor(params, textures, material);
  } else if (type == "dielectric") {
    dielectric(params, textures, diagnostics, material);
  } else {
    params.fail("the material type '" + type + "' is not known yet; use diffuse, conductor or dielectric");
  }
  params.warn_unused(diagnostics);
  return material;
}

}  // namespace bdpt_tool
