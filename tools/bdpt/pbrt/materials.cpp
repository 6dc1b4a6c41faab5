// SPDX-License-Identifier: Apache-2.0
#include "pbrt/materials.h"

#include <algorithm>
#include <cmath>

#include "pbrt/spectra.h"

namespace bdpt_tool {
namespace {

constexpr float kLeastAlpha = 1e-4f;  // of one axis, where the other is not smooth

float constant_float(const ParamList& params, const std::string& name, float fallback, TextureTable& textures) {
  const std::string texture = params.get_texture(name);
  if (texture.empty()) return params.get_float(name, fallback);
  const TextureValue value = textures.resolve(texture, params);
  if (value.is_image()) params.fail(*params.find(name), "cannot be an image yet; give one number");
  return value.constant[0];
}

// One number, or an image's times 1.
struct Alpha {
  float constant = 0;
  TextureUse texture;

  bool operator==(const Alpha&) const = default;
};

Alpha alpha(const ParamList& params, const std::string& name, const Alpha& fallback, bool remap,
            TextureTable& textures) {
  if (!params.has(name)) return fallback;
  const std::string texture = params.get_texture(name);
  float roughness = 0;
  if (texture.empty()) {
    roughness = params.get_float(name, 0);
  } else {
    const TextureValue value = textures.resolve_alpha(texture, params, remap);
    if (value.is_image()) return {1, value.use};
    roughness = value.constant[0];
  }
  if (roughness < 0) params.fail("a roughness below zero");
  const float alpha = remap ? std::sqrt(roughness) : roughness;
  if (alpha > 1) params.fail("a roughness above 1 is not known; use 1");
  return {alpha, {}};
}

// `prefix` is that of one of the two surfaces of a coated conductor. The library has one picture for both axes.
void roughness(const ParamList& params, TextureTable& textures, Diagnostics& diagnostics, const std::string& prefix,
               std::array<float, 2>& to, TextureUse& texture) {
  const bool remap = params.get_bool("remaproughness", true);
  const Alpha both = alpha(params, prefix + "roughness", {}, remap, textures);
  std::array<Alpha, 2> axes = {alpha(params, prefix + "uroughness", both, remap, textures),
                               alpha(params, prefix + "vroughness", both, remap, textures)};
  to = {axes[0].constant, axes[1].constant};
  if (axes[0] == axes[1] && axes[0].texture.texture >= 0) {
    texture = axes[0].texture;
    return;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (axes[i].texture.texture < 0) continue;
    to[i] = textures.mean(axes[i].texture)[0];
    diagnostics.warn(params.where(), params.directive() + ": " + prefix + (i == 0 ? "u" : "v") +
                                         "roughness is a picture, and the other axis has another or none: the mean of "
                                         "its alpha, " +
                                         std::to_string(to[i]) + ", is taken");
  }
  if (std::max(to[0], to[1]) < kSmoothAlpha) {
    to = {0, 0};
  } else {
    to = {std::max(to[0], kLeastAlpha), std::max(to[1], kLeastAlpha)};
  }
}

void color(const ParamList& params, const std::string& name, float fallback, TextureTable& textures, Rgb& factor,
           TextureUse& use) {
  const std::string texture = params.get_texture(name);
  if (texture.empty()) {
    factor = params.get_rgb(name, {fallback, fallback, fallback});
  } else {
    const TextureValue value = textures.resolve(texture, params);
    factor = value.constant;
    use = value.use;
  }
  for (float& x : factor) x = std::clamp(x, 0.0f, 1.0f);
}

void reflectance(const ParamList& params, float fallback, TextureTable& textures, MaterialDescription& material) {
  color(params, "reflectance", fallback, textures, material.reflectance, material.reflectance_texture);
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

// The index with eta = 1 that has this reflectance at normal incidence.
void set_index(const Rgb& reflectance, MaterialDescription& material) {
  for (std::size_t c = 0; c < 3; ++c) {
    const float r = std::clamp(reflectance[c], 0.0f, 0.9999f);
    material.eta[c] = 1;
    material.k[c] = 2 * std::sqrt(r) / std::sqrt(1 - r);
  }
}

void conductor(const ParamList& params, TextureTable& textures, Diagnostics& diagnostics, const std::string& prefix,
               MaterialDescription& material) {
  if (const Param* param = params.find("reflectance")) {
    if (params.has(prefix + "eta") || params.has(prefix + "k")) params.fail(*param, "and eta or k exclude each other");
    reflectance(params, 0, textures, material);
    Rgb color = material.reflectance;
    if (material.reflectance_texture.texture >= 0) {
      color = textures.mean(material.reflectance_texture);
      if (material.type == BDPT_MATERIAL_COATED_CONDUCTOR) {
        diagnostics.warn(param->where,
                         params.directive() + ": of the metal's reflectance, a picture, the mean is taken");
        material.reflectance_texture = {};
      }
    }
    set_index(color, material);
  } else {
    material.eta = index_part(params, prefix + "eta", "metal-Cu-eta");
    material.k = index_part(params, prefix + "k", "metal-Cu-k");
  }
  for (int c = 0; c < 3; ++c) {
    if (material.eta[c] < 0 || material.k[c] < 0) params.fail("eta and k must not be negative");
  }
}

float checked(const ParamList& params, float eta) {
  if (!(eta >= 0.1f && eta <= 10)) params.fail("eta must be between 0.1 and 10");
  return eta;
}

float dielectric_index(const ParamList& params, Diagnostics& diagnostics, const std::string& name = "eta") {
  const Param* param = params.find(name);
  if (!param) return 1.5f;
  if (param->type == "float") return checked(params, params.get_float(name, 1.5f));
  if (param->type == "spectrum" && !param->strings.empty()) {
    const auto index = named_glass(param->strings[0]);
    if (!index) {
      params.fail(*param, "names the glass '" + param->strings[0] + "', which is not known; give \"float eta\"");
    }
    diagnostics.warn(param->where, params.directive() + ": this program works in RGB, the glass does not disperse");
    return checked(params, *index);
  }
  const Rgb eta = params.get_rgb(name, {});
  if (std::max({eta[0], eta[1], eta[2]}) > 1.001f * std::min({eta[0], eta[1], eta[2]})) {
    diagnostics.warn(param->where, params.directive() + ": this program works in RGB, the glass does not disperse");
  }
  return checked(params, eta[1]);
}

void coat(const ParamList& params, TextureTable& textures, Diagnostics& diagnostics, const std::string& prefix,
          CoatDescription& to) {
  roughness(params, textures, diagnostics, prefix, to.roughness, to.roughness_texture);
  to.ior = dielectric_index(params, diagnostics, prefix + "eta");
  to.thickness = constant_float(params, "thickness", 0.01f, textures);
  to.g = constant_float(params, "g", 0, textures);
  to.albedo = params.get_rgb("albedo", {0, 0, 0});
  // Of pbrt's own random walk in the layers.
  params.ignore("maxdepth");
  params.ignore("nsamples");
  if (!(to.thickness >= 0)) params.fail("thickness must not be negative");
  if (!(to.g >= -1 && to.g <= 1)) params.fail("g must be between -1 and 1");
  for (const float a : to.albedo) {
    if (!(a >= 0 && a <= 1)) params.fail("albedo must be between 0 and 1");
  }
}

void diffuse_transmission(const ParamList& params, TextureTable& textures, MaterialDescription& material) {
  reflectance(params, 0.25f, textures, material);
  color(params, "transmittance", 0.25f, textures, material.transmittance.factor, material.transmittance.texture);
  const float scale = params.get_float("scale", 1);
  if (!(scale >= 0 && scale <= 1)) params.fail("scale must be between 0 and 1");
  for (std::size_t c = 0; c < 3; ++c) {
    material.reflectance[c] *= scale;
    material.transmittance.factor[c] *= scale;
  }
}

void surface_maps(const ParamList& params, TextureTable& textures, MaterialDescription& material) {
  const std::string normals = params.get_string("normalmap", "");
  if (!normals.empty()) {
    material.normal.texture.texture = textures.linear_image(normals, params.find("normalmap")->where);
  }
  const std::string heights = params.get_texture("displacement");
  if (!heights.empty()) material.bump.texture = textures.resolve(heights, params).use;
}

}  // namespace

MaterialDescription convert_material(const std::string& type, const ParamList& params, TextureTable& textures,
                                     Diagnostics& diagnostics) {
  MaterialDescription material;
  material.where = params.where();
  material.single_scattering = true;  // as in pbrt
  surface_maps(params, textures, material);
  if (type == "diffuse") {
    material.type = BDPT_MATERIAL_DIFFUSE;
    reflectance(params, 0.5f, textures, material);
  } else if (type == "conductor") {
    material.type = BDPT_MATERIAL_CONDUCTOR;
    conductor(params, textures, diagnostics, "", material);
    roughness(params, textures, diagnostics, "", material.roughness, material.roughness_texture);
  } else if (type == "dielectric") {
    material.type = BDPT_MATERIAL_DIELECTRIC;
    material.ior = dielectric_index(params, diagnostics);
    roughness(params, textures, diagnostics, "", material.roughness, material.roughness_texture);
  } else if (type == "thindielectric") {
    material.type = kMaterialThinDielectric;
    material.ior = dielectric_index(params, diagnostics);
  } else if (type == "coateddiffuse") {
    material.type = BDPT_MATERIAL_COATED_DIFFUSE;
    reflectance(params, 0.5f, textures, material);
    coat(params, textures, diagnostics, "", material.coat);
  } else if (type == "coatedconductor") {
    material.type = BDPT_MATERIAL_COATED_CONDUCTOR;
    conductor(params, textures, diagnostics, "conductor.", material);
    roughness(params, textures, diagnostics, "conductor.", material.roughness, material.roughness_texture);
    coat(params, textures, diagnostics, "interface.", material.coat);
  } else if (type == "diffusetransmission") {
    material.type = BDPT_MATERIAL_DIFFUSE_TRANSMISSION;
    diffuse_transmission(params, textures, material);
  } else if (type == "interface" || type == "none" || type.empty()) {
    material.type = BDPT_MATERIAL_INTERFACE;
  } else {
    params.fail("the material type '" + type +
                "' is not known yet; use diffuse, conductor, dielectric, thindielectric, coateddiffuse, "
                "coatedconductor, diffusetransmission, mix or interface");
  }
  params.warn_unused(diagnostics);
  return material;
}

}  // namespace bdpt_tool
