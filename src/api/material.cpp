#include "api/builder.h"
#include "api/check.h"
#include "api/desc.h"
#include "api/texture_use.h"

using namespace bdpt;

namespace {

constexpr float kDefaultIor = 1.5f;
constexpr float kDefaultCutoff = 0.5f;

void check_fields(const Subject& subject, const bdpt_material_desc& desc) {
  subject.check_enum("type", desc.type, BDPT_MATERIAL_INTERFACE);
  subject.check_range("reflectance", desc.reflectance, 3, 0, 1);
  subject.check_flag("one_sided", desc.one_sided);
  subject.check_not_negative("eta", desc.eta, 3);
  subject.check_not_negative("k", desc.k, 3);
  if (desc.ior != 0) subject.check_range("ior", desc.ior, 0.1f, 10);
  subject.check_range("roughness", desc.roughness, 2, 0, 1);
  subject.check_not_negative("emission", desc.emission, 3);
  subject.check_flag("emission_two_sided", desc.emission_two_sided);
  subject.check_range("emission_group", desc.emission_group, 0, 63);
  subject.check_flag("perceptual_roughness", desc.perceptual_roughness);
  subject.check_enum("opacity_mode", desc.opacity_mode, BDPT_OPACITY_BLEND);
  subject.check_range("opacity", &desc.opacity, 1, 0, 1);
  subject.check_range("opacity_cutoff", &desc.opacity_cutoff, 1, 0, 1);
  subject.check_range("emission_exponent", desc.emission_exponent, -1, 10000);
}

// What only the type in question asks for.
void check_type(const Subject& subject, const bdpt_material_desc& desc) {
  const bool dielectric = desc.type == BDPT_MATERIAL_DIELECTRIC, conductor = desc.type == BDPT_MATERIAL_CONDUCTOR;
  const bool interface = desc.type == BDPT_MATERIAL_INTERFACE;
  if (!dielectric && !interface && desc.interior.id != 0)
    subject.refuse("interior", "is set, but no light passes the surface: set it to zero");
  if (!dielectric && !interface && desc.priority != 0)
    subject.refuse("priority", "is ", desc.priority, ", but no light passes the surface: set it to 0");
  if (interface && desc.one_sided)
    subject.refuse("one_sided", "is 1, but light passes through an interface: set it to 0");
  for (int i = 0; interface && i < 3; ++i)
    if (desc.emission[i] > 0)
      subject.refuse("emission", "is set, but nothing is to be seen of an interface: set it to zero");
  if (dielectric && desc.one_sided)
    subject.refuse("one_sided", "is 1, but light passes through a dielectric: set it to 0");
  if ((dielectric || conductor || interface) && desc.reflectance_texture.id != 0)
    subject.refuse("reflectance_texture",
                   "is set: only diffuse materials and mirrors have a reflectance; set it to zero");
  if ((dielectric || conductor) && (desc.roughness[0] == 0) != (desc.roughness[1] == 0))
    subject.refuse("roughness", "is (", desc.roughness[0], ", ", desc.roughness[1],
                   "): give two values above 0, or two zeros for a smooth surface");
  for (int i = 0; conductor && i < 3; ++i)
    if (desc.eta[i] == 0 && desc.k[i] == 0)
      subject.refuse("eta and k", "are both 0 in channel ", i, ": give the metal's complex index of refraction");
}

Opacity read_opacity(const Subject& subject, const bdpt_material_desc& desc) {
  Opacity opacity;
  if (desc.opacity_mode == BDPT_OPACITY_OPAQUE) return opacity;
  for (float v : desc.emission)
    if (v > 0) subject.refuse("opacity_mode", "is not opaque, but the material emits: give it no emission");
  opacity.mode = desc.opacity_mode == BDPT_OPACITY_MASK ? Opacity::Mode::Mask : Opacity::Mode::Blend;
  opacity.value = desc.opacity;
  opacity.cutoff = desc.opacity_cutoff == 0 ? kDefaultCutoff : desc.opacity_cutoff;
  return opacity;
}

MaterialEntry read_material(bdpt_builder& builder, const bdpt_material_desc& desc) {
  const Subject subject("material", desc.label);
  check_fields(subject, desc);
  check_type(subject, desc);
  MaterialEntry entry;
  entry.label = subject.label();
  MaterialDesc& m = entry.material;
  m.type = static_cast<MaterialType>(desc.type);
  m.reflectance = to_rgb(desc.reflectance);
  m.eta = to_rgb(desc.eta);
  m.k = to_rgb(desc.k);
  m.ior = desc.ior == 0 ? kDefaultIor : desc.ior;
  const auto alpha = [&](float roughness) { return desc.perceptual_roughness ? roughness * roughness : roughness; };
  m.alpha_u = alpha(desc.roughness[0]);
  m.alpha_v = alpha(desc.roughness[1]);
  m.one_sided = desc.one_sided != 0;
  m.emission = to_rgb(desc.emission);
  m.emission_two_sided = desc.emission_two_sided != 0;
  m.emission_group = desc.emission_group;
  m.opacity = read_opacity(subject, desc);
  m.priority = desc.priority;
  if (desc.interior.id != 0) builder.media.at(desc.interior.id, "desc.interior");
  entry.medium = desc.interior.id;
  read_texture_uses(builder, subject, desc, entry);
  m.emission_exponent = desc.emission_exponent;
  return entry;
}

void use_parts(bdpt_builder& builder, const MaterialEntry& material) {
  for (uint64_t id : material.textures) ++builder.textures[id].users;
  if (material.medium) ++builder.media[material.medium].users;
}

void leave_parts(bdpt_builder& builder, const MaterialEntry& material) {
  for (uint64_t id : material.textures) --builder.textures[id].users;
  if (material.medium) --builder.media[material.medium].users;
}

}  // namespace

bdpt_result bdpt_material_add(bdpt_builder* builder, const bdpt_material_desc* desc, bdpt_material_id* material) {
  return guard(__func__, [&] {
    reset_output(material);
    bdpt_builder& b = writable(builder);
    const bdpt_material_desc d = read_struct(desc, "desc");
    require(material, "material");
    material->id = b.materials.add(read_material(b, d));
    use_parts(b, b.materials[material->id]);
  });
}

bdpt_result bdpt_material_update(bdpt_builder* builder, bdpt_material_id material, const bdpt_material_desc* desc) {
  return guard(__func__, [&] {
    bdpt_builder& b = writable(builder);
    const bdpt_material_desc d = read_struct(desc, "desc");
    MaterialEntry& entry = b.materials.at(material.id, "material");
    MaterialEntry updated = read_material(b, d);
    updated.users = entry.users;
    use_parts(b, updated);
    leave_parts(b, entry);
    entry = std::move(updated);
  });
}

bdpt_result bdpt_material_remove(bdpt_builder* builder, bdpt_material_id material) {
  return guard(__func__, [&] {
    bdpt_builder& b = writable(builder);
    const MaterialEntry& entry = b.materials.at(material.id, "material");
    check_unused(entry.users, "material", entry.label, "instance");
    leave_parts(b, entry);
    b.materials.take(material.id);
  });
}
