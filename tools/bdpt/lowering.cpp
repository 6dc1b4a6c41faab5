// SPDX-License-Identifier: Apache-2.0
#include "lowering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bdpt_tool {
namespace {

// Below the first a surface is smooth; the second is how close to 1 a reflectance by a complex index comes.
constexpr double kSmoothAlpha = 1e-3, kMaxReflectance = 0.9999;
constexpr float kMinIor = 1, kMaxIor = 10, kDefaultIor = 1.5f;

const TextureDescription& texture_of(const SceneDescription& scene, const TextureUse& use) {
  return scene.textures[static_cast<std::size_t>(use.texture)];
}

Rgb mean_of(const TextureDescription& texture) {
  const Image linear = to_linear(texture.image, texture.exponent);
  std::array<double, 3> sum = {};
  for (std::size_t i = 0; i < linear.pixels.size(); ++i) sum[i % 3] += static_cast<double>(linear.pixels[i]);
  const double texels = static_cast<double>(linear.width) * linear.height;
  return {static_cast<float>(sum[0] / texels), static_cast<float>(sum[1] / texels),
          static_cast<float>(sum[2] / texels)};
}

// By solid angle.
Rgb mean_of_sphere(const TextureDescription& texture) {
  const Image linear = to_linear(texture.image, texture.exponent);
  std::array<double, 3> sum = {};
  double weights = 0;
  for (std::uint32_t y = 0; y < linear.height; ++y) {
    const double weight = std::sin(std::numbers::pi * (y + 0.5) / linear.height);
    weights += weight * linear.width;
    const float* row = &linear.pixels[std::size_t{3} * linear.width * y];
    for (std::size_t i = 0; i < std::size_t{3} * linear.width; ++i) sum[i % 3] += weight * static_cast<double>(row[i]);
  }
  return {static_cast<float>(sum[0] / weights), static_cast<float>(sum[1] / weights),
          static_cast<float>(sum[2] / weights)};
}

std::array<float, 2> ggx_alpha(float roughness) {
  const double alpha = static_cast<double>(roughness) * static_cast<double>(roughness);
  if (alpha < kSmoothAlpha) return {0, 0};
  return {static_cast<float>(alpha), static_cast<float>(alpha)};
}

// The index with eta = 1 whose reflectance at normal incidence is this.
void set_conductor(const Rgb& reflectance, MaterialDescription& to) {
  to.type = BDPT_MATERIAL_CONDUCTOR;
  for (std::size_t c = 0; c < 3; ++c) {
    const double r = std::clamp(static_cast<double>(reflectance[c]), 0.0, kMaxReflectance);
    to.eta[c] = 1;
    to.k[c] = static_cast<float>(2 * std::sqrt(r) / std::sqrt(1 - r));
  }
}

class Lowering {
 public:
  Lowering(const SceneDescription& scene, const MaterialDescription& from, Notes& notes)
      : scene_(scene), from_(from), to_(from), notes_(notes), where_(from.label) {}

  MaterialDescription run() {
    switch (from_.type) {
      case kMaterialPrincipled:
        lower_principled();
        break;
      case kMaterialCoatedDiffuse:
        to_.type = BDPT_MATERIAL_DIFFUSE;
        note("coats of dielectric are left out: what lies below them is seen");
        break;
      case kMaterialCoatedConductor:
        to_.type = BDPT_MATERIAL_CONDUCTOR;
        note("coats of dielectric are left out: what lies below them is seen");
        break;
      case kMaterialDiffuseTransmission:
        to_.type = BDPT_MATERIAL_DIFFUSE;
        note("diffuse transmission is left out: light is reflected alone");
        break;
      case kMaterialThinDielectric:
        to_.type = BDPT_MATERIAL_DIELECTRIC;
        note("thin-walled transmission is taken as solid glass, which refracts");
        break;
      case kMaterialMix:
        note("a mix of materials becomes the one that it has more of");
        return lowered(scene_, scene_.materials[static_cast<std::size_t>(from_.mixed[from_.mix_amount.factor > 0.5f])],
                       notes_);
      default:
        break;
    }
    if (to_.type == BDPT_MATERIAL_DIELECTRIC) {
      to_.one_sided = false;
      if (!(to_.ior >= 0.1f && to_.ior <= kMaxIor)) {
        note("an index of refraction outside [1, 10] becomes 1.5");
        to_.ior = kDefaultIor;
      }
    }
    lower_roughness();
    lower_emission();
    lower_alpha();
    lower_textures();
    return to_;
  }

 private:
  void note(const char* text) { notes_.add(text, where_); }
  bool textured(const FloatValue& value) const { return value.texture.texture >= 0; }

  void lower_principled() {
    const PrincipledDescription& p = from_.principled;
    if (from_.unlit) {
      to_.type = BDPT_MATERIAL_DIFFUSE;
      to_.reflectance = {0, 0, 0};
      to_.reflectance_texture = {};
    } else if (p.transmission.factor >= 0.5f) {
      principled_glass(p);
    } else if (p.metallic.factor == 1 && !textured(p.metallic) && from_.reflectance_texture.texture < 0) {
      set_conductor(from_.reflectance, to_);
      to_.roughness = ggx_alpha(p.roughness.factor);
    } else {
      principled_diffuse(p);
    }
    const bool coated = p.clearcoat.factor > 0;
    const bool sheen = p.sheen_color.factor != Rgb{0, 0, 0};
    if (coated) note("clear coats are left out");
    if (sheen) note("sheen is left out");
    if (p.iridescence.factor > 0) note("iridescence is left out");
    if (p.anisotropy.factor > 0) note("anisotropy is left out");
    if (p.dispersion > 0) note("dispersion is left out: this program works in RGB");
  }

  void principled_glass(const PrincipledDescription& p) {
    to_.type = BDPT_MATERIAL_DIELECTRIC;
    if (from_.ior < kMinIor) to_.ior = 0;  // is told of where all indices are
    to_.roughness = ggx_alpha(p.roughness.factor);
    if (p.transmission.factor < 1) note("transmission of half and more is taken as whole");
    if (textured(p.transmission)) note("textures of transmission are left out");
    if (p.thickness.factor == 0) note("thin-walled transmission is taken as solid glass, which refracts");
    if (p.attenuation_distance > 0) note("absorption in a volume is left out");
    if (from_.reflectance != Rgb{1, 1, 1} || from_.reflectance_texture.texture >= 0) note("glass has no base colour");
    to_.reflectance_texture = {};
  }

  void principled_diffuse(const PrincipledDescription& p) {
    to_.type = BDPT_MATERIAL_DIFFUSE;
    if (p.transmission.factor > 0) note("transmission of less than half is left out");
    if (textured(p.metallic) && p.metallic.factor > 0) {
      note("materials whose metalness is a texture are taken as diffuse");
    } else if (p.metallic.factor > 0) {
      note("metals of textured colour, and half metals, are taken as diffuse");
    } else {
      note("materials that are no metal are taken as diffuse, without the gloss on top");
    }
  }

  void lower_emission() {
    if (from_.emission_texture.texture < 0 || !from_.emits()) return;
    note("a texture of emission becomes its mean");
    const Rgb mean = mean_of(texture_of(scene_, from_.emission_texture));
    for (std::size_t c = 0; c < 3; ++c) to_.emission[c] *= mean[c];
  }

  bool is_smooth_or_rough() const {
    return to_.type == BDPT_MATERIAL_CONDUCTOR || to_.type == BDPT_MATERIAL_DIELECTRIC;
  }

  // The texture of what is smooth by its factor has nothing to vary.
  void lower_roughness() {
    if (!is_smooth_or_rough() || to_.roughness[0] == 0) to_.principled.roughness.texture = {};
  }

  void lower_alpha() {
    if (to_.alpha_mode == AlphaMode::kMask && to_.alpha_cutoff <= 0) to_.alpha_mode = AlphaMode::kOpaque;
    if (to_.alpha_mode == AlphaMode::kOpaque) return;
    if (to_.alpha_cutoff > 1) {  // nothing is there
      to_.alpha_cutoff = 1;
      to_.alpha.factor = 0;
    }
    if (!to_.emits()) return;
    note("alpha of what emits is left out");
    to_.alpha_mode = AlphaMode::kOpaque;
  }

  void lower_textures() {
    if (is_smooth_or_rough()) {
      to_.reflectance_texture = {};
      if (from_.uses_vertex_colors) note("colours of vertices are left out, but of what is diffuse");
    }
    for (const TextureUse* use : {&to_.reflectance_texture, &to_.normal.texture, &to_.bump.texture, &to_.alpha.texture,
                                  &to_.principled.roughness.texture}) {
      if (use->texture < 0) continue;
      const auto& wrap = texture_of(scene_, *use).wrap;
      if (wrap[0] == Wrap::kBlack || wrap[1] == Wrap::kBlack)
        note("textures are repeated, not black beyond their edges");
    }
  }

  const SceneDescription& scene_;
  const MaterialDescription& from_;
  MaterialDescription to_;
  Notes& notes_;
  std::string where_;
};

}  // namespace

MaterialDescription lowered(const SceneDescription& scene, const MaterialDescription& material, Notes& notes) {
  return Lowering(scene, material, notes).run();
}

bool lower(const SceneDescription& scene, LightDescription& light, Notes& notes) {
  if (light.type == kLightDirectional) {
    notes.add("directional lights are not known yet, and are left out", light.label);
    return false;
  }
  if (light.type == BDPT_LIGHT_ENVIRONMENT && light.texture >= 0) {
    notes.add("the picture of an environment becomes its mean", light.label);
    const Rgb mean = mean_of_sphere(scene.textures[static_cast<std::size_t>(light.texture)]);
    for (std::size_t c = 0; c < 3; ++c) light.value[c] *= mean[c];
    light.texture = -1;
  }
  return true;
}

void tell_what_is_lost(const SceneDescription& scene, Diagnostics& diagnostics) {
  Notes notes(scene.path, diagnostics);
  std::vector<bool> seen(scene.materials.size());
  for (const InstanceDescription& instance : scene.instances) {
    const auto material = static_cast<std::size_t>(instance.material);
    if (seen[material]) continue;
    seen[material] = true;
    lowered(scene, scene.materials[material], notes);
  }
  for (LightDescription light : scene.lights) lower(scene, light, notes);
  notes.tell();
}

}  // namespace bdpt_tool
