// SPDX-License-Identifier: Apache-2.0
#include "scene_upload.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lowering.h"
#include "scene_colors.h"

namespace bdpt_tool {
namespace {

// Bytes the library wants to be able to read behind the last element.
constexpr std::size_t kSlack = 16;

template <class T>
void release_vector(void* user, const void*) {
  delete static_cast<std::vector<T>*>(user);
}

// The vector lives on the heap until the library lets go of it.
template <class T>
bdpt_data lend(std::vector<T>&& values, std::size_t components, bdpt_format format) {
  bdpt_data data{};
  if (values.empty()) return data;
  data.count = values.size() / components;
  values.resize(values.size() + kSlack / sizeof(T));
  auto* owner = new std::vector<T>(std::move(values));
  data.data = owner->data();
  data.format = format;
  data.ownership = BDPT_OWNERSHIP_BORROW;
  data.slack_bytes = kSlack;
  data.release = release_vector<T>;
  data.user = owner;
  return data;
}

bdpt_wrap wrap_of(Wrap wrap) {
  if (wrap == Wrap::kMirror) return BDPT_WRAP_MIRROR;
  return wrap == Wrap::kClamp ? BDPT_WRAP_CLAMP : BDPT_WRAP_REPEAT;
}

class Uploader {
 public:
  Uploader(bdpt_context* context, SceneDescription& description)
      : context_(context),
        description_(description),
        silent_(false),
        notes_(description.path, silent_),
        builder_(make<Builder>("the scene", bdpt_builder_create, context)) {}

  Scene build(bdpt_cancel* cancel) {
    SceneDescription plain;
    for (const MaterialDescription& material : description_.materials) {
      plain.materials.push_back(lowered(description_, material, notes_));
    }
    plain.lights = description_.lights;
    plain.media = description_.media;
    convert_colors(context_, plain);
    lowered_ = std::move(plain.materials);
    described_media_ = std::move(plain.media);
    materials_.resize(lowered_.size());
    media_.resize(described_media_.size());
    shapes_.resize(description_.shapes.size());
    textures_.resize(description_.textures.size());
    for (InstanceDescription& instance : description_.instances) add(instance);
    for (const LightDescription& light : plain.lights) add(light);
    auto desc = sized<bdpt_build_desc>();
    desc.cancel = cancel;
    if (description_.medium >= 0) desc.medium = once(media_, described_media_, description_.medium);
    bdpt_scene* scene = nullptr;
    check(bdpt_scene_build(builder_.get(), &desc, &scene), description_.path);
    return Scene(scene);
  }

 private:
  // The first call makes it; others give the same.
  template <class Id, class T>
  Id once(std::vector<std::optional<Id>>& ids, std::vector<T>& things, int index) {
    auto& id = ids[static_cast<std::size_t>(index)];
    if (!id) id = add(things[static_cast<std::size_t>(index)]);
    return *id;
  }

  bdpt_shape_id add(ShapeDescription& shape) {
    bdpt_shape_id id{};
    if (const auto* sphere = std::get_if<SphereShape>(&shape.geometry)) {
      auto desc = sized<bdpt_sphere_desc>();
      desc.radius = sphere->radius;
      desc.label = shape.label.c_str();
      check(bdpt_sphere_add(builder_.get(), &desc, &id), shape.where);
      return id;
    }
    auto& mesh = std::get<TriangleMesh>(shape.geometry);
    auto desc = sized<bdpt_mesh_desc>();
    desc.label = shape.label.c_str();
    desc.positions = lend(std::move(mesh.positions), 3, BDPT_FORMAT_FLOAT3);
    desc.indices = lend(std::move(mesh.indices), 3, BDPT_FORMAT_UINT32X3);
    desc.normals = lend(std::move(mesh.normals), 3, BDPT_FORMAT_FLOAT3);
    desc.tangents = lend(std::move(mesh.tangents), 4, BDPT_FORMAT_FLOAT4);
    desc.colors = lend(std::move(mesh.colors), 4, BDPT_FORMAT_FLOAT4);
    desc.uv[0] = lend(std::move(mesh.uv), 2, BDPT_FORMAT_FLOAT2);
    desc.uv[1] = lend(std::move(mesh.uv_lightmap), 2, BDPT_FORMAT_FLOAT2);
    check(bdpt_mesh_add(builder_.get(), &desc, &id), shape.where);
    return id;
  }

  template <class T>
  static void set_pixels(const CodedImage<T>& image, bdpt_texture_desc& desc) {
    desc.channels = image.channels;
    desc.pixels = image.pixels.data();
    desc.texel = sizeof(T) == 1 ? BDPT_TEXEL_UINT8 : BDPT_TEXEL_UINT16;
  }
  static void set_pixels(const Image& image, bdpt_texture_desc& desc) {
    desc.channels = 3;
    desc.pixels = image.pixels.data();
    desc.texel = BDPT_TEXEL_FLOAT;
  }

  // Curves that the library does not know are undone here.
  bdpt_texture_id add(const TextureDescription& texture) {
    auto desc = sized<bdpt_texture_desc>();
    desc.label = texture.label.c_str();
    desc.width = width_of(texture.image);
    desc.height = height_of(texture.image);
    desc.encoding = texture.exponent == 0 ? BDPT_ENCODING_SRGB : BDPT_ENCODING_LINEAR;
    Image linear;
    // Floats of a colour are linear already; numbers that are no colours are never converted.
    if (std::holds_alternative<Image>(texture.image) && texture.exponent != 1) {
      desc.encoding = 0;
      desc.color_space = "lin_rec709";
    }
    if (texture.exponent == 0 || texture.exponent == 1) {
      std::visit([&](const auto& image) { set_pixels(image, desc); }, texture.image);
    } else {
      linear = to_linear(texture.image, texture.exponent);
      set_pixels(linear, desc);
      desc.encoding = 0;
      desc.color_space = "lin_rec709";
    }
    bdpt_texture_id id{};
    check(bdpt_texture_add(builder_.get(), &desc, &id), texture.where);
    return id;
  }

  void use(const TextureUse& from, bdpt_slot slot, int channel, float scale, std::vector<bdpt_texture_use>& uses) {
    if (from.texture < 0) return;
    const TextureDescription& texture = description_.textures[static_cast<std::size_t>(from.texture)];
    auto to = sized<bdpt_texture_use>();
    to.slot = slot;
    to.texture = once(textures_, description_.textures, from.texture);
    to.channel = static_cast<std::uint32_t>(channel);
    to.uv_set = static_cast<std::uint32_t>(from.uv_set);
    std::copy(from.transform.begin(), from.transform.end(), to.transform);
    for (std::size_t i = 0; i < 2; ++i) to.wrap[i] = wrap_of(texture.wrap[i]);
    to.lookup = texture.nearest ? BDPT_LOOKUP_NEAREST : BDPT_LOOKUP_BILINEAR;
    to.scale = scale;
    uses.push_back(to);
  }

  void set_opacity(const MaterialDescription& material, bdpt_material_desc& desc, std::vector<bdpt_texture_use>& uses) {
    if (material.alpha_mode == AlphaMode::kOpaque) return;
    desc.opacity_mode = material.alpha_mode == AlphaMode::kMask ? BDPT_OPACITY_MASK : BDPT_OPACITY_BLEND;
    desc.opacity = material.alpha.factor;
    desc.opacity_cutoff = material.alpha_cutoff;
    use(material.alpha.texture, BDPT_SLOT_OPACITY, material.alpha.channel, 0, uses);
  }

  bdpt_medium_id add(const MediumDescription& medium) {
    auto desc = sized<bdpt_medium_desc>();
    desc.label = medium.label.c_str();
    std::copy_n(medium.sigma_a.data(), 3, desc.sigma_a);
    std::copy_n(medium.sigma_s.data(), 3, desc.sigma_s);
    desc.g = medium.g;
    bdpt_medium_id id{};
    check(bdpt_medium_add(builder_.get(), &desc, &id), medium.where);
    return id;
  }

  // A number that multiplies its texture; where it is zero there is nothing to multiply.
  float number(const FloatValue& value, bdpt_slot slot, std::vector<bdpt_texture_use>& uses) {
    if (value.factor != 0) use(value.texture, slot, value.channel, 0, uses);
    return value.factor;
  }
  void color(const ColorValue& value, bdpt_slot slot, float* to, std::vector<bdpt_texture_use>& uses) {
    std::copy_n(value.factor.data(), 3, to);
    if (value.factor != Rgb{0, 0, 0}) use(value.texture, slot, 0, 0, uses);
  }

  void set_principled(const MaterialDescription& material, bdpt_material_desc& desc,
                      std::vector<bdpt_texture_use>& uses) {
    constexpr float kDegrees = 57.29577951f;
    const PrincipledDescription& p = material.principled;
    desc.perceptual_roughness = 1;
    std::fill_n(desc.roughness, 2, number(p.roughness, BDPT_SLOT_ROUGHNESS, uses));
    desc.metalness = number(p.metallic, BDPT_SLOT_METALNESS, uses);
    desc.specular = number(p.specular, BDPT_SLOT_SPECULAR, uses);
    if (desc.specular == 0) desc.specular = -1;
    color(p.specular_color, BDPT_SLOT_SPECULAR_COLOR, desc.specular_color, uses);
    desc.transmission = number(p.transmission, BDPT_SLOT_TRANSMISSION, uses);
    desc.thin_walled = p.thickness.factor == 0;
    desc.coat = number(p.clearcoat, BDPT_SLOT_COAT, uses);
    if (desc.coat > 0) desc.coat_roughness = number(p.clearcoat_roughness, BDPT_SLOT_COAT_ROUGHNESS, uses);
    color(p.sheen_color, BDPT_SLOT_SHEEN_COLOR, desc.sheen_color, uses);
    if (p.sheen_color.factor != Rgb{0, 0, 0})
      desc.sheen_roughness = number(p.sheen_roughness, BDPT_SLOT_SHEEN_ROUGHNESS, uses);
    desc.anisotropy = p.anisotropy.factor;
    desc.anisotropy_rotation = p.anisotropy_rotation * kDegrees;
    if (desc.anisotropy != 0) use(p.anisotropy.texture, BDPT_SLOT_ANISOTROPY, 0, 0, uses);
    if (desc.transmission > 0 && !desc.thin_walled) desc.interior = absorption(material);
  }

  // What is left after the distance has the colour. Source: KHR_materials_volume.
  bdpt_medium_id absorption(const MaterialDescription& material) {
    constexpr float kDarkest = 1e-6f;
    const PrincipledDescription& p = material.principled;
    if (!(p.attenuation_distance > 0) || p.attenuation_color == Rgb{1, 1, 1}) return {};
    MediumDescription medium;
    medium.label = material.label;
    medium.where = material.where;
    for (std::size_t c = 0; c < 3; ++c)
      medium.sigma_a[c] = -std::log(std::max(p.attenuation_color[c], kDarkest)) / p.attenuation_distance;
    return add(medium);
  }

  void set_mix(const MaterialDescription& material, bdpt_material_desc& desc, std::vector<bdpt_texture_use>& uses) {
    desc.mix = number(material.mix_amount, BDPT_SLOT_MIX, uses);
    for (std::size_t i = 0; i < 2; ++i) {
      SceneDescription part;
      part.materials.push_back(lowered_part(description_, material.mixed[i], notes_));
      convert_colors(context_, part);
      desc.parts[i] = add(part.materials[0]);
    }
  }

  bdpt_material_id add(const MaterialDescription& material) {
    auto desc = sized<bdpt_material_desc>();
    std::vector<bdpt_texture_use> uses;
    desc.type = material.type;
    desc.label = material.label.c_str();
    std::copy_n(material.reflectance.data(), 3, desc.reflectance);
    use(material.reflectance_texture, BDPT_SLOT_REFLECTANCE, 0, 0, uses);
    std::copy_n(material.eta.data(), 3, desc.eta);
    std::copy_n(material.k.data(), 3, desc.k);
    desc.ior = material.ior;
    std::copy_n(material.roughness.data(), 2, desc.roughness);
    desc.single_scattering = material.single_scattering;
    if (material.type == BDPT_MATERIAL_PRINCIPLED) set_principled(material, desc, uses);
    if (material.type == BDPT_MATERIAL_MIX) set_mix(material, desc, uses);
    if (material.type == BDPT_MATERIAL_DIFFUSE_TRANSMISSION)
      color(material.transmittance, BDPT_SLOT_TRANSMITTANCE, desc.transmittance, uses);
    if (material.type == BDPT_MATERIAL_COATED_CONDUCTOR) {
      desc.coat_ior = material.coat.ior;
      desc.coat_roughness = std::sqrt(material.coat.roughness[0] * material.coat.roughness[1]);
    }
    if (material.interior >= 0) desc.interior = once(media_, described_media_, material.interior);
    std::copy_n(material.emission.data(), 3, desc.emission);
    if (material.emits()) use(material.emission_texture, BDPT_SLOT_EMISSION, 0, 0, uses);
    desc.emission_two_sided = material.emission_two_sided;
    desc.one_sided = material.one_sided;
    use(material.normal.texture, BDPT_SLOT_NORMAL, 0, material.normal.factor, uses);
    use(material.bump.texture, BDPT_SLOT_BUMP, material.bump.channel, material.bump.factor, uses);
    set_opacity(material, desc, uses);
    desc.textures = uses.data();
    desc.texture_count = static_cast<std::uint32_t>(uses.size());
    bdpt_material_id id{};
    check(bdpt_material_add(builder_.get(), &desc, &id), material.where);
    return id;
  }

  // What parts no media is no surface here.
  bool is_nothing(const MaterialDescription& material) const {
    return material.type == BDPT_MATERIAL_INTERFACE && material.interior == description_.medium;
  }

  void add(InstanceDescription& instance) {
    if (is_nothing(lowered_[static_cast<std::size_t>(instance.material)])) return;
    auto desc = sized<bdpt_instance_desc>();
    desc.label = instance.label.c_str();
    desc.shape = once(shapes_, description_.shapes, instance.shape);
    desc.material = instance.material_id = once(materials_, lowered_, instance.material);
    std::copy_n(instance.transform.data(), 12, desc.transform);
    check(bdpt_instance_add(builder_.get(), &desc, &instance.id), instance.where);
  }

  void add(const LightDescription& light) {
    auto desc = sized<bdpt_light_desc>();
    desc.type = light.type;
    desc.label = light.label.c_str();
    std::copy_n(light.position.data(), 3, desc.position);
    std::copy_n(light.direction.data(), 3, desc.direction);
    std::copy_n(light.up.data(), 3, desc.up);
    float* value = light.type == BDPT_LIGHT_ENVIRONMENT   ? desc.radiance
                   : light.type == BDPT_LIGHT_DIRECTIONAL ? desc.irradiance
                                                          : desc.intensity;
    std::copy_n(light.value.data(), 3, value);
    if (light.type == BDPT_LIGHT_SPOT) {
      desc.cone_angle = light.cone_angle;
      desc.cone_falloff = light.cone_falloff;
    }
    desc.angular_radius = light.angular_radius;
    if (light.texture >= 0) desc.texture = once(textures_, description_.textures, light.texture);
    if (light.type == BDPT_LIGHT_ENVIRONMENT) std::copy_n(light.transform.data(), 12, desc.transform);
    auto photometry = sized<bdpt_photometry>();
    if (light.luminaire) {
      photometry.vertical_count = static_cast<std::uint32_t>(light.luminaire->vertical_angles.size());
      photometry.horizontal_count = static_cast<std::uint32_t>(light.luminaire->horizontal_angles.size());
      photometry.vertical_angles = light.luminaire->vertical_angles.data();
      photometry.horizontal_angles = light.luminaire->horizontal_angles.data();
      photometry.intensities = light.luminaire->candela.data();
      desc.photometry = &photometry;
    }
    std::vector<bdpt_portal> portals;
    for (const PortalDescription& p : light.portals) {
      bdpt_portal& portal = portals.emplace_back();
      std::copy_n(p.corner.data(), 3, portal.corner);
      std::copy_n(p.edge_u.data(), 3, portal.edge_u);
      std::copy_n(p.edge_v.data(), 3, portal.edge_v);
    }
    desc.portals = portals.data();
    desc.portal_count = static_cast<std::uint32_t>(portals.size());
    bdpt_light_id id{};
    check(bdpt_light_add(builder_.get(), &desc, &id), light.where);
  }

  bdpt_context* context_;
  SceneDescription& description_;
  Diagnostics silent_;  // whoever read the scene told of all that is lost
  Notes notes_;
  Builder builder_;
  std::vector<MaterialDescription> lowered_;
  std::vector<MediumDescription> described_media_;
  std::vector<std::optional<bdpt_shape_id>> shapes_;
  std::vector<std::optional<bdpt_texture_id>> textures_;
  std::vector<std::optional<bdpt_material_id>> materials_;
  std::vector<std::optional<bdpt_medium_id>> media_;
};

}  // namespace

Scene build_scene(bdpt_context* context, SceneDescription& description, bdpt_cancel* cancel) {
  return Uploader(context, description).build(cancel);
}

}  // namespace bdpt_tool
