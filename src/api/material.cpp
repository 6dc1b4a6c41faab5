#include "api/builder.h"
#include "api/check.h"
#include "api/desc.h"
#include "api/host_material.h"
#include "api/texture_use.h"
#include "material/metals.h"

using namespace bdpt;

namespace {

constexpr float kDefaultIor = 1.5f;
constexpr float kDefaultCutoff = 0.5f;
constexpr float kMaxMetal = 1e6f;  // of eta and k, whose fourth powers Fresnel's equations have
constexpr float kDefaultFilmIor = 1.3f, kDefaultFilmThickness = 400, kMaxFilmThickness = 1e5f;

void check_fields(const Subject& subject, const bdpt_material_desc& desc) {
  subject.check_enum("type", desc.type, BDPT_MATERIAL_BRUSHED);
  subject.check_range("reflectance", desc.reflectance, 3, 0, 1);
  subject.check_flag("one_sided", desc.one_sided);
  subject.check_range("eta", desc.eta, 3, 0, kMaxMetal);
  subject.check_range("k", desc.k, 3, 0, kMaxMetal);
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
  subject.check_range("transmittance", desc.transmittance, 3, 0, 1);
  subject.check_range("specular_color", desc.specular_color, 3, 0, 1);
  subject.check_range("sheen_color", desc.sheen_color, 3, 0, 1);
  if (desc.coat_ior != 0) subject.check_range("coat_ior", desc.coat_ior, 1, 10);
  if (desc.iridescence_ior != 0) subject.check_range("iridescence_ior", desc.iridescence_ior, 1, 10);
  subject.check_range("iridescence_thickness", desc.iridescence_thickness, 0, kMaxFilmThickness);
  subject.check_range("iridescence_thickness_minimum", desc.iridescence_thickness_minimum, 0, kMaxFilmThickness);
  if (desc.specular != -1) subject.check_range("specular", desc.specular, 0, 1);
  subject.check_finite("anisotropy_rotation", desc.anisotropy_rotation);
  subject.check_flag("thin_walled", desc.thin_walled);
  subject.check_flag("single_scattering", desc.single_scattering);
  subject.check_reserved("reserved_2", desc.reserved_2);
  const std::pair<const char*, float> parts[] = {{"diffuse_roughness", desc.diffuse_roughness},
                                                 {"coat", desc.coat},
                                                 {"coat_roughness", desc.coat_roughness},
                                                 {"metalness", desc.metalness},
                                                 {"sheen_roughness", desc.sheen_roughness},
                                                 {"transmission", desc.transmission},
                                                 {"diffuse_transmission", desc.diffuse_transmission},
                                                 {"anisotropy", desc.anisotropy},
                                                 {"iridescence", desc.iridescence},
                                                 {"mix", desc.mix}};
  for (const auto& [field, value] : parts) subject.check_range(field, value, 0, 1);
}

// Types that have the numbers in question.
bool has_microfacets(bdpt_material_type type) {
  return type == BDPT_MATERIAL_CONDUCTOR || type == BDPT_MATERIAL_DIELECTRIC || type == BDPT_MATERIAL_COATED_DIFFUSE ||
         type == BDPT_MATERIAL_COATED_CONDUCTOR || type == BDPT_MATERIAL_PRINCIPLED;
}
bool is_conductor(bdpt_material_type type) {
  return type == BDPT_MATERIAL_CONDUCTOR || type == BDPT_MATERIAL_COATED_CONDUCTOR;
}
bool has_reflectance(bdpt_material_type type) {
  return !is_conductor(type) && type != BDPT_MATERIAL_DIELECTRIC && type != BDPT_MATERIAL_INTERFACE &&
         type != BDPT_MATERIAL_MIX;
}

// What only the type in question asks for.
void check_type(const Subject& subject, const bdpt_material_desc& desc) {
  const bool encloses = desc.type == BDPT_MATERIAL_DIELECTRIC || desc.type == BDPT_MATERIAL_INTERFACE ||
                        (desc.type == BDPT_MATERIAL_PRINCIPLED && desc.transmission > 0 && !desc.thin_walled);
  if (!encloses && desc.interior.id != 0)
    subject.refuse("interior", "is set, but no light passes the surface: set it to zero");
  if (!encloses && desc.priority != 0)
    subject.refuse("priority", "is ", desc.priority, ", but no light passes the surface: set it to 0");
  for (int i = 0; desc.type == BDPT_MATERIAL_INTERFACE && i < 3; ++i)
    if (desc.emission[i] > 0)
      subject.refuse("emission", "is set, but nothing is to be seen of an interface: set it to zero");
  if (!has_reflectance(desc.type) && desc.reflectance_texture.id != 0)
    subject.refuse("reflectance_texture",
                   "is set, but conductors, dielectrics, interfaces and mixes have no reflectance: set it to zero");
  if (has_microfacets(desc.type) && (desc.roughness[0] == 0) != (desc.roughness[1] == 0))
    subject.refuse("roughness", "is (", desc.roughness[0], ", ", desc.roughness[1],
                   "): give two values above 0, or two zeros for a smooth surface");
  for (int i = 0; is_conductor(desc.type) && i < 3; ++i)
    if (desc.eta[i] == 0 && desc.k[i] == 0)
      subject.refuse("eta and k", "are both 0 in channel ", i, ": give the metal's complex index of refraction");
  if (desc.type == BDPT_MATERIAL_COATED_DIFFUSE && desc.ior != 0) subject.check_range("ior", desc.ior, 1, 10);
  for (int i = 0; desc.type == BDPT_MATERIAL_DIFFUSE_TRANSMISSION && i < 3; ++i) {
    const float reflectance = desc.reflectance_texture.id != 0 ? 1 : desc.reflectance[i];
    if (reflectance + desc.transmittance[i] > 1 + 1e-6f)
      subject.refuse("transmittance", "is ", desc.transmittance[i], " in channel ", i, ", and reflectance ",
                     reflectance, ": together a surface gives back at most 1");
  }
  if (desc.type == BDPT_MATERIAL_PRINCIPLED && desc.transmission > 0 && desc.diffuse_transmission > 0 &&
      !desc.thin_walled)
    subject.refuse("diffuse_transmission", "is ", desc.diffuse_transmission, " and transmission ", desc.transmission,
                   ": both go together only where thin_walled is 1");
  if (desc.type == BDPT_MATERIAL_PRINCIPLED && encloses && desc.iridescence > 0 && desc.ior != 0 &&
      std::fabs(desc.ior - 1) < 1e-4f)
    subject.refuse("iridescence", "is ", desc.iridescence, ", but ior is ", desc.ior,
                   ", and light passes such a surface as if there were none: set thin_walled to 1, or another ior");
  if (desc.type == BDPT_MATERIAL_HOST && !desc.host)
    subject.refuse("host", "is NULL: give the functions of a material of type HOST");
  if (desc.type != BDPT_MATERIAL_HOST && desc.host) subject.refuse("host", "is set: only type HOST takes it");
  for (const bdpt_material_id& part : desc.parts)
    if (desc.type != BDPT_MATERIAL_MIX && part.id != 0) subject.refuse("parts", "are set: only type MIX takes them");
}

// Throws unless the material may be part of a mix.
void check_part(const Subject& subject, const MaterialEntry& entry) {
  const MaterialDesc& m = entry.material;
  if (m.type == MaterialType::Mix) subject.refuse("type", "is MIX: a mix is made of two that are none");
  if (!is_black(m.emission)) subject.refuse("emission", "is not zero: of a mix only the mix itself can emit");
  if (m.type == MaterialType::Interface || entry.medium != 0 || m.priority > 0)
    subject.refuse("type, interior or priority", "make it a boundary of media: a mix encloses nothing");
  if (m.opacity.mode != Opacity::Mode::Opaque)
    subject.refuse("opacity_mode", "is not opaque: give opacity to the mix itself");
  for (const TextureUse& use : m.textures)
    if (use.slot == Slot::Normal || use.slot == Slot::Bump)
      subject.refuse("textures", "have a normal or bump map: give it to the mix itself");
}

void read_parts(bdpt_builder& builder, const bdpt_material_desc& desc, MaterialEntry& entry) {
  for (int i = 0; i < 2; ++i) {
    const char* name = i ? "desc.parts[1]" : "desc.parts[0]";
    const MaterialEntry& part = builder.materials.at(desc.parts[i].id, name);
    check_part(Subject(("material of " + std::string(name)).c_str(), part.label.c_str()), part);
    entry.parts[i] = desc.parts[i].id;
  }
}

bool transmits(bdpt_builder& builder, const MaterialEntry& entry) {
  if (entry.material.type != MaterialType::Mix) return entry.material.transmits();
  return builder.materials[entry.parts[0]].material.transmits() ||
         builder.materials[entry.parts[1]].material.transmits();
}

void read_principled(const bdpt_material_desc& desc, MaterialDesc& m) {
  m.coat = desc.coat;
  m.metalness = desc.metalness;
  m.specular = desc.specular == 0 ? 1 : desc.specular == -1 ? 0 : desc.specular;
  m.specular_color = to_rgb(desc.specular_color);
  if (is_black(m.specular_color)) m.specular_color = Rgb(1);
  m.sheen = to_rgb(desc.sheen_color);
  m.transmission = desc.transmission;
  m.diffuse_transmission = desc.diffuse_transmission;
  m.anisotropy = desc.anisotropy;
  m.thin_walled = desc.thin_walled != 0;
  if (desc.iridescence == 0) return;
  m.film = desc.iridescence;
  m.film_ior = desc.iridescence_ior == 0 ? kDefaultFilmIor : desc.iridescence_ior;
  m.film_thickness = desc.iridescence_thickness == 0 ? kDefaultFilmThickness : desc.iridescence_thickness;
  m.least_film_thickness = desc.iridescence_thickness_minimum;
}

Opacity read_opacity(const Subject& subject, const bdpt_material_desc& desc) {
  Opacity opacity;
  if (desc.opacity_mode == BDPT_OPACITY_OPAQUE) return opacity;
  for (float v : desc.emission)
    if (v > 0) subject.refuse("opacity_mode", "is not opaque, but the material emits: give it no emission");
  if (desc.type == BDPT_MATERIAL_INTERFACE || desc.interior.id != 0 || desc.priority != 0)
    subject.refuse("opacity_mode",
                   "is not opaque, but the surface bounds a medium, and what has holes encloses nothing: "
                   "give it no interior and no priority, and a type that is no INTERFACE");
  opacity.mode = desc.opacity_mode == BDPT_OPACITY_MASK ? Opacity::Mode::Mask : Opacity::Mode::Blend;
  opacity.value = desc.opacity;
  opacity.cutoff = desc.opacity_cutoff == 0 ? kDefaultCutoff : desc.opacity_cutoff;
  return opacity;
}

MaterialEntry read_material(bdpt_builder& builder, const bdpt_material_desc& desc, FinalCall drop) {
  const Subject subject("material", desc.label);
  check_fields(subject, desc);
  check_type(subject, desc);
  MaterialEntry entry;
  entry.label = subject.label();
  MaterialDesc& m = entry.material;
  m.type = static_cast<MaterialType>(desc.type);
  if (desc.type == BDPT_MATERIAL_DIFFUSE && desc.diffuse_roughness > 0) m.type = MaterialType::RoughDiffuse;
  m.reflectance = to_rgb(desc.reflectance);
  m.eta = to_rgb(desc.eta);
  m.k = to_rgb(desc.k);
  m.ior = desc.ior == 0 ? kDefaultIor : desc.ior;
  const auto alpha = [&](float roughness) { return desc.perceptual_roughness ? roughness * roughness : roughness; };
  m.alpha_u = alpha(desc.roughness[0]);
  m.alpha_v = alpha(desc.roughness[1]);
  m.single_scattering = desc.single_scattering != 0;
  m.one_sided = desc.one_sided != 0;
  m.diffuse_roughness = desc.diffuse_roughness;
  m.transmittance = to_rgb(desc.transmittance);
  m.coat_ior = desc.coat_ior == 0 ? kDefaultIor : desc.coat_ior;
  m.coat_alpha = alpha(desc.coat_roughness);
  m.sheen_alpha = alpha(desc.sheen_roughness);
  const double turn = double(desc.anisotropy_rotation) * (M_PI / 180);
  if (desc.anisotropy_rotation != 0) m.tangent_cos = float(std::cos(turn)), m.tangent_sin = float(std::sin(turn));
  if (desc.type == BDPT_MATERIAL_PRINCIPLED) read_principled(desc, m);
  if (desc.type == BDPT_MATERIAL_MIX) {
    m.reflectance = Rgb(1);
    m.mix = desc.mix;
    read_parts(builder, desc, entry);
  }
  if (desc.type == BDPT_MATERIAL_HOST) {
    const bdpt_host_material host = read_struct(desc.host, "desc.host");
    m.host_owner = read_host_material(subject, host, std::move(drop));
    m.host = m.host_owner.get();
    m.thin_walled = host.transmits != 0;
  }
  if (m.one_sided && transmits(builder, entry))
    subject.refuse("one_sided", "is 1, but light passes through this material: set it to 0");
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

void count_users(bdpt_builder& builder, const MaterialEntry& material, uint64_t by) {
  for (uint64_t id : material.textures) builder.textures[id].users += by;
  if (material.medium) builder.media[material.medium].users += by;
  if (material.material.type != MaterialType::Mix) return;
  for (uint64_t id : material.parts) builder.materials[id].users += by, builder.materials[id].mixes += by;
}
void enter(bdpt_builder& builder, const MaterialEntry& material) { count_users(builder, material, 1); }
void leave(bdpt_builder& builder, const MaterialEntry& material) { count_users(builder, material, ~uint64_t(0)); }

}  // namespace

bdpt_result bdpt_material_add(bdpt_builder* builder, const bdpt_material_desc* desc, bdpt_material_id* material) {
  return guard(__func__, [&] {
    reset_output(material);
    FinalCall drop = host_drop(desc);
    bdpt_builder& b = writable(builder);
    const bdpt_material_desc d = read_struct(desc, "desc");
    require(material, "material");
    material->id = b.materials.add(read_material(b, d, std::move(drop)));
    enter(b, b.materials[material->id]);
  });
}

bdpt_result bdpt_material_update(bdpt_builder* builder, bdpt_material_id material, const bdpt_material_desc* desc) {
  return guard(__func__, [&] {
    FinalCall drop = host_drop(desc);
    bdpt_builder& b = writable(builder);
    const bdpt_material_desc d = read_struct(desc, "desc");
    MaterialEntry& entry = b.materials.at(material.id, "material");
    MaterialEntry updated = read_material(b, d, std::move(drop));
    if (entry.mixes > 0 || updated.parts[0] == material.id || updated.parts[1] == material.id)
      check_part(Subject("material that is part of a mix,", updated.label.c_str()), updated);
    enter(b, updated);
    leave(b, entry);
    updated.users = entry.users;
    updated.mixes = entry.mixes;
    entry = std::move(updated);
  });
}

bdpt_result bdpt_material_remove(bdpt_builder* builder, bdpt_material_id material) {
  return guard(__func__, [&] {
    bdpt_builder& b = writable(builder);
    const MaterialEntry& entry = b.materials.at(material.id, "material");
    check_unused(entry.users, "material", entry.label, entry.mixes > 0 ? "instance or mixture" : "instance");
    leave(b, entry);
    b.materials.take(material.id);
  });
}

bdpt_result bdpt_metal_find(const char* name, float eta[3], float k[3]) {
  return guard(__func__, [&] {
    require(name, "name"), require(eta, "eta"), require(k, "k");
    const Metal* metal = find_metal(name);
    if (!metal)
      fail(ErrorCode::InvalidArgument, "name is \"", name, "\", which is no metal: give one of ", metal_names());
    eta[0] = metal->eta.r, eta[1] = metal->eta.g, eta[2] = metal->eta.b;
    k[0] = metal->k.r, k[1] = metal->k.g, k[2] = metal->k.b;
  });
}
