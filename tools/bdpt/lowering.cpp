// SPDX-License-Identifier: Apache-2.0
#include "lowering.h"

#include <algorithm>
#include <cmath>

namespace bdpt_tool {
namespace {

constexpr float kSmoothAlpha = 1e-3f;  // below it a surface is smooth
constexpr float kMinIor = 1, kMaxIor = 10, kDefaultIor = 1.5f;
constexpr float kDark = 1e-6f;  // of a colour that must not be zero
constexpr float kIndexMatched = 1e-4f, kMostFilmIor = 10, kMostFilmThickness = 1e5f;

const TextureDescription& texture_of(const SceneDescription& scene, const TextureUse& use) {
  return scene.textures[static_cast<std::size_t>(use.texture)];
}

class Lowering {
 public:
  Lowering(const SceneDescription& scene, const MaterialDescription& from, Notes& notes)
      : scene_(scene), from_(from), to_(from), notes_(notes), where_(from.label) {}

  MaterialDescription run() {
    switch (from_.type) {
      case BDPT_MATERIAL_PRINCIPLED:
        lower_principled();
        break;
      case BDPT_MATERIAL_CONDUCTOR:
        if (from_.reflectance_texture.texture >= 0) lower_textured_metal();
        break;
      case BDPT_MATERIAL_COATED_DIFFUSE:
        to_.ior = from_.coat.ior;
        to_.roughness = from_.coat.roughness;
        to_.roughness_texture = from_.coat.roughness_texture;
        lower_coat(to_.ior);
        break;
      case BDPT_MATERIAL_COATED_CONDUCTOR:
        lower_coat(to_.coat.ior);
        if (from_.coat.roughness[0] != from_.coat.roughness[1]) note("coats are rough alike in all directions");
        break;
      case BDPT_MATERIAL_DIFFUSE_TRANSMISSION:
        lower_diffuse_transmission();
        break;
      case kMaterialThinDielectric:
        to_.type = BDPT_MATERIAL_PRINCIPLED;
        to_.reflectance = {1, 1, 1};
        to_.principled.transmission.factor = 1;
        to_.principled.roughness.factor = 0;
        break;
      case BDPT_MATERIAL_MIX:
        lower_mix();
        break;
      case BDPT_MATERIAL_INTERFACE:
        lower_interface();
        break;
      default:
        break;
    }
    if (passes_light()) to_.one_sided = false;
    lower_index();
    lower_alpha();
    lower_textures();
    return to_;
  }

 private:
  void note(const char* text) { notes_.add(text, where_); }
  const MaterialDescription& part(int index) const {
    return scene_.materials[static_cast<std::size_t>(from_.mixed[static_cast<std::size_t>(index)])];
  }

  void lower_principled() {
    if (from_.unlit) {
      to_.type = BDPT_MATERIAL_DIFFUSE;
      to_.reflectance = {0, 0, 0};
      to_.reflectance_texture = {};
      return;
    }
    PrincipledDescription& p = to_.principled;
    if (p.roughness.factor * p.roughness.factor < kSmoothAlpha)
      p.roughness = {.factor = 0, .texture = {}, .channel = 1};
    bound(p.specular_color.factor, "a colour of gloss above 1 becomes 1");
    bound(p.sheen_color.factor, "a colour of sheen above 1 becomes 1");
    for (float& channel : p.specular_color.factor) channel = std::max(channel, kDark);
    if (p.iridescence.factor > 0) lower_film(p);
    if (p.dispersion > 0) note("dispersion is left out: this program works in RGB");
    if (p.clearcoat.factor > 0 && p.clearcoat_normal.texture.texture >= 0)
      note("normal maps of clear coats are left out: they are those of what lies below");
  }

  void lower_film(PrincipledDescription& p) {
    if (p.transmission.factor > 0 && p.thickness.factor > 0 && std::abs(to_.ior - 1) < kIndexMatched) {
      note("iridescence of what does not refract is left out");
      p.iridescence = {.factor = 0, .texture = {}, .channel = 0};
    }
    const auto bound_film = [&](float& value, float most, const char* text) {
      if (value > most) note(text);
      value = std::min(value, most);
    };
    bound_film(p.iridescence_ior, kMostFilmIor, "films of an index above 10 have one of 10");
    for (float* thickness : {&p.iridescence_thickness.factor, &p.iridescence_thickness_min})
      bound_film(*thickness, kMostFilmThickness, "films thicker than 100 micrometres are so thick");
  }

  void bound(Rgb& color, const char* text) {
    for (float& channel : color) {
      if (channel > 1) note(text);
      channel = std::min(channel, 1.0f);
    }
  }

  void lower_textured_metal() {
    note("metals whose reflectance is a picture have Schlick's Fresnel, which differs at grazing angles");
    if (from_.roughness[0] != from_.roughness[1])
      note("metals whose reflectance is a picture are rough alike in all directions");
    to_.type = BDPT_MATERIAL_PRINCIPLED;
    to_.principled.metallic.factor = 1;
    to_.principled.roughness = {std::sqrt(from_.roughness[0] * from_.roughness[1]), from_.roughness_texture, 0};
    to_.principled.roughness_is_alpha = true;
  }

  void lower_coat(float& ior) {
    if (from_.coat.albedo != Rgb{0, 0, 0}) note("coats of dielectric are clear: what they scatter is left out");
    if (ior >= kMinIor) return;
    note("coats of an index below 1 have that of 1.5");
    ior = kDefaultIor;
  }

  void lower_diffuse_transmission() {
    for (std::size_t c = 0; c < 3; ++c) {
      const float sum = to_.reflectance[c] + to_.transmittance.factor[c];
      if (sum <= 1) continue;
      note("what reflects and transmits more than it receives is darkened to what it receives");
      to_.reflectance[c] /= sum;
      to_.transmittance.factor[c] /= sum;
    }
  }

  // What is partly an interface is there with that probability.
  void lower_mix() {
    for (int i = 0; i < 2; ++i) {
      if (part(i).type != BDPT_MATERIAL_INTERFACE || part(1 - i).type == BDPT_MATERIAL_INTERFACE) continue;
      if (i == 1 && from_.mix_amount.texture.texture >= 0) break;
      to_ = lowered(scene_, part(1 - i), notes_);
      to_.alpha_mode = AlphaMode::kBlend;
      to_.alpha = from_.mix_amount;
      if (i == 1) to_.alpha.factor = 1 - from_.mix_amount.factor;
      to_.emission = from_.emission;
      return;
    }
    const bool has_odd_part =
        std::any_of(from_.mixed.begin(), from_.mixed.end(), [&](int i) { return is_odd_part(i); });
    if (!has_odd_part) {
      for (int i = 0; i < 2; ++i) {
        if (part(i).normal.texture.texture >= 0 || part(i).bump.texture.texture >= 0)
          note("normal and bump maps of what is mixed are left out");
      }
      return;
    }
    note("a mix of mixes or interfaces becomes what it has more of");
    to_ = lowered(scene_, part(from_.mix_amount.factor > 0.5f), notes_);
    to_.emission = from_.emission;
  }

  bool is_odd_part(int material) const {
    const bdpt_material_type type = scene_.materials[static_cast<std::size_t>(material)].type;
    return type == BDPT_MATERIAL_MIX || type == BDPT_MATERIAL_INTERFACE;
  }

  void lower_interface() {
    to_.alpha_mode = AlphaMode::kOpaque;
    if (!to_.emits()) return;
    note("interfaces do not shine, as in pbrt");
    to_.emission = {};
  }

  bool passes_light() const {
    return to_.type == BDPT_MATERIAL_DIELECTRIC || to_.type == BDPT_MATERIAL_INTERFACE ||
           to_.type == BDPT_MATERIAL_DIFFUSE_TRANSMISSION || to_.type == BDPT_MATERIAL_MIX ||
           (to_.type == BDPT_MATERIAL_PRINCIPLED && to_.principled.transmission.factor > 0);
  }

  void lower_index() {
    if (to_.type != BDPT_MATERIAL_DIELECTRIC && to_.type != BDPT_MATERIAL_PRINCIPLED) return;
    const float least = to_.type == BDPT_MATERIAL_PRINCIPLED ? kMinIor : 1 / kMaxIor;
    if (to_.ior >= least && to_.ior <= kMaxIor) return;
    note("an index of refraction outside [1, 10] becomes 1.5");
    to_.ior = kDefaultIor;
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
    const bool is_plain = to_.type == BDPT_MATERIAL_CONDUCTOR || to_.type == BDPT_MATERIAL_DIELECTRIC ||
                          to_.type == BDPT_MATERIAL_COATED_CONDUCTOR;
    if (is_plain || to_.type == BDPT_MATERIAL_MIX || to_.type == BDPT_MATERIAL_INTERFACE) to_.reflectance_texture = {};
    if (is_plain && from_.uses_vertex_colors) note("colours of vertices are left out of metals and glass");
    for (const TextureUse* use :
         {&to_.reflectance_texture, &to_.normal.texture, &to_.bump.texture, &to_.alpha.texture, &to_.emission_texture,
          &to_.roughness_texture, &to_.coat.roughness_texture, &to_.principled.roughness.texture}) {
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

MaterialDescription lowered_part(const SceneDescription& scene, int material, Notes& notes) {
  MaterialDescription part = lowered(scene, scene.materials[static_cast<std::size_t>(material)], notes);
  part.normal.texture = part.bump.texture = {};
  part.alpha_mode = AlphaMode::kOpaque;
  part.emission = {};
  part.interior = -1;
  part.principled.attenuation_distance = 0;
  return part;
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
  notes.tell();
}

}  // namespace bdpt_tool
