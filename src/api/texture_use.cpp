#include "api/texture_use.h"

#include "api/desc.h"
#include "api/host_array.h"

#include <algorithm>
#include <iterator>

namespace bdpt {
namespace {

constexpr uint32_t kMaxUses = 64;
constexpr float kMaxLevel = 16;

// What a slot is, and which kinds of materials have the number.
struct SlotKind {
  const char* name;
  Slot slot;
  bool is_number;   // takes a channel
  bool is_bounded;  // at most 1
  bool has_scale;
  uint32_t materials;  // bits 1 << BDPT_MATERIAL_X
};

constexpr uint32_t kAll = ~0u;
constexpr uint32_t bit(bdpt_material_type type) { return 1u << type; }
constexpr uint32_t kSurfaces = kAll & ~bit(BDPT_MATERIAL_INTERFACE);
constexpr uint32_t kPrincipled = bit(BDPT_MATERIAL_PRINCIPLED);

// In the order of bdpt_slot; opacity has no Slot of its own.
constexpr SlotKind kSlots[] = {
    {"REFLECTANCE", Slot::Reflectance, false, true, false,
     ~(bit(BDPT_MATERIAL_CONDUCTOR) | bit(BDPT_MATERIAL_DIELECTRIC) | bit(BDPT_MATERIAL_INTERFACE) |
       bit(BDPT_MATERIAL_COATED_CONDUCTOR) | bit(BDPT_MATERIAL_MIX))},
    {"ROUGHNESS", Slot::Roughness, true, true, false,
     bit(BDPT_MATERIAL_CONDUCTOR) | bit(BDPT_MATERIAL_DIELECTRIC) | bit(BDPT_MATERIAL_COATED_DIFFUSE) |
         bit(BDPT_MATERIAL_COATED_CONDUCTOR) | kPrincipled | bit(BDPT_MATERIAL_HOST)},
    {"NORMAL", Slot::Normal, false, false, true, kSurfaces},
    {"BUMP", Slot::Bump, true, false, true, kSurfaces},
    {"OPACITY", Slot::Reflectance, true, true, false, kAll},
    {"EMISSION", Slot::Emission, false, false, false, kSurfaces},
    {"DIFFUSE_ROUGHNESS", Slot::DiffuseRoughness, true, true, false,
     bit(BDPT_MATERIAL_DIFFUSE) | bit(BDPT_MATERIAL_COATED_DIFFUSE) | kPrincipled},
    {"TRANSMITTANCE", Slot::Transmittance, false, true, false, bit(BDPT_MATERIAL_DIFFUSE_TRANSMISSION) | kPrincipled},
    {"METALNESS", Slot::Metalness, true, true, false, kPrincipled},
    {"SPECULAR", Slot::Specular, true, true, false, kPrincipled},
    {"SPECULAR_COLOR", Slot::SpecularColor, false, true, false, kPrincipled},
    {"COAT", Slot::Coat, true, true, false, kPrincipled},
    {"COAT_ROUGHNESS", Slot::CoatRoughness, true, true, false, kPrincipled | bit(BDPT_MATERIAL_COATED_CONDUCTOR)},
    {"SHEEN_COLOR", Slot::Sheen, false, true, false, kPrincipled},
    {"SHEEN_ROUGHNESS", Slot::SheenRoughness, true, true, false, kPrincipled},
    {"TRANSMISSION", Slot::Transmission, true, true, false, kPrincipled},
    {"DIFFUSE_TRANSMISSION", Slot::DiffuseTransmission, true, true, false, kPrincipled},
    {"ANISOTROPY", Slot::Anisotropy, false, true, false, kPrincipled},
    {"MIX", Slot::Mix, true, true, false, bit(BDPT_MATERIAL_MIX)},
    {"IRIDESCENCE", Slot::Film, true, true, false, kPrincipled},
    {"IRIDESCENCE_THICKNESS", Slot::FilmThickness, true, true, false, kPrincipled},
};
constexpr bdpt_slot kLastSlot = BDPT_SLOT_IRIDESCENCE_THICKNESS;
static_assert(std::size(kSlots) == kLastSlot + 1);

// Whether what the slot's texture multiplies is 0, and so the texture would do nothing.
bool has_nothing_to_vary(const bdpt_material_desc& desc, bdpt_slot slot) {
  switch (slot) {
    case BDPT_SLOT_ROUGHNESS:
      return desc.roughness[0] == 0 && desc.roughness[1] == 0;
    case BDPT_SLOT_DIFFUSE_ROUGHNESS:
      return desc.diffuse_roughness == 0;
    case BDPT_SLOT_TRANSMITTANCE:
      return is_black(to_rgb(desc.transmittance));
    case BDPT_SLOT_METALNESS:
      return desc.metalness == 0;
    case BDPT_SLOT_COAT:
      return desc.coat == 0;
    case BDPT_SLOT_COAT_ROUGHNESS:
      return desc.coat_roughness == 0;
    case BDPT_SLOT_SHEEN_COLOR:
      return is_black(to_rgb(desc.sheen_color));
    case BDPT_SLOT_SHEEN_ROUGHNESS:
      return desc.sheen_roughness == 0;
    case BDPT_SLOT_TRANSMISSION:
      return desc.transmission == 0;
    case BDPT_SLOT_DIFFUSE_TRANSMISSION:
      return desc.diffuse_transmission == 0;
    case BDPT_SLOT_ANISOTROPY:
      return desc.anisotropy == 0;
    case BDPT_SLOT_MIX:
      return desc.mix == 0;
    case BDPT_SLOT_IRIDESCENCE:
    case BDPT_SLOT_IRIDESCENCE_THICKNESS:
      return desc.iridescence == 0;
    default:
      return false;
  }
}

// Whether its number is an alpha, which perceptual roughness is the root of.
constexpr bool is_alpha(bdpt_slot slot) {
  return slot == BDPT_SLOT_ROUGHNESS || slot == BDPT_SLOT_COAT_ROUGHNESS || slot == BDPT_SLOT_SHEEN_ROUGHNESS;
}

UvMap read_uv(const Subject& subject, const bdpt_texture_use& desc) {
  UvMap uv;
  uv.set = uint8_t(desc.uv_set);
  if (std::all_of(desc.transform, desc.transform + 6, [](float v) { return v == 0; })) return uv;
  subject.check_finite("transform", desc.transform, 6);
  std::copy(desc.transform, desc.transform + 6, uv.m);
  const double det = double(uv.m[0]) * double(uv.m[4]) - double(uv.m[1]) * double(uv.m[3]);
  if (!(std::fabs(det) > 1e-30))
    subject.refuse("transform", "is singular: give one that can be inverted, or six zeros for identity");
  return uv;
}

TextureSampler read_sampler(const Subject& subject, const bdpt_texture_use& desc) {
  subject.check_enum("wrap[0]", desc.wrap[0], BDPT_WRAP_CLAMP);
  subject.check_enum("wrap[1]", desc.wrap[1], BDPT_WRAP_CLAMP);
  subject.check_enum("lookup", desc.lookup, BDPT_LOOKUP_BICUBIC);
  subject.check_range("level", desc.level, 0, kMaxLevel);
  return {TextureWrap(desc.wrap[0]), TextureWrap(desc.wrap[1]), TextureFilter(desc.lookup), desc.level};
}

class UseReader {
 public:
  UseReader(bdpt_builder& builder, const Subject& material, const bdpt_material_desc& desc, MaterialEntry& entry)
      : builder_(builder), material_(material), desc_(desc), entry_(entry) {}

  void read(const bdpt_texture_use& use, const Subject& subject) {
    subject.check_enum("slot", use.slot, kLastSlot);
    subject.check_reserved("reserved", use.reserved);
    subject.check_range("uv_set", use.uv_set, 0, 1);
    const SlotKind& kind = kSlots[use.slot];
    subject.check_range("channel", use.channel, 0, kind.is_number ? 3 : 0);
    subject.check_finite("scale", use.scale);
    if (!kind.has_scale && use.scale != 0)
      subject.refuse("scale", "is ", use.scale, ": of slot ", kind.name, " give 0");
    if (!(kind.materials >> desc_.type & 1u))
      subject.refuse("slot", "is ", kind.name, ", which ", material_.name(), " of this type has no use for");
    if (taken_ >> use.slot & 1u) subject.refuse("slot", "is ", kind.name, " for a second time: give each slot once");
    taken_ |= 1u << use.slot;
    if (has_nothing_to_vary(desc_, use.slot))
      subject.refuse("slot", "is ", kind.name, ", which multiplies the material's, and that is 0: set it");
    TextureUse result;
    result.texture = add(use.texture.id, subject, "texture", kind);
    result.slot = kind.slot;
    result.channel = uint8_t(use.channel);
    result.squared = is_alpha(use.slot) && desc_.perceptual_roughness;
    result.scale = use.scale == 0 ? 1 : use.scale;
    result.uv = read_uv(subject, use);
    result.sampler = read_sampler(subject, use);
    result.is_hosts = is_hosts(use, subject);
    if (use.slot != BDPT_SLOT_OPACITY) {
      entry_.material.textures.push_back(result);
      return;
    }
    Opacity& opacity = entry_.material.opacity;
    if (opacity.mode == Opacity::Mode::Opaque)
      subject.refuse("slot", "is OPACITY although opacity_mode is opaque: choose MASK or BLEND");
    opacity.texture = result.texture;
    opacity.channel = result.channel;
    opacity.uv = result.uv;
    opacity.sampler = result.sampler;
  }

  bool has(bdpt_slot slot) const { return taken_ >> slot & 1u; }
  // The short form.
  void read_reflectance() {
    if (taken_ & 1u)
      material_.refuse("reflectance_texture", "is set beside a use of slot REFLECTANCE: give one of them");
    TextureUse use;
    use.texture = add(desc_.reflectance_texture.id, material_, "reflectance_texture", kSlots[BDPT_SLOT_REFLECTANCE]);
    use.is_hosts = builder_.textures[desc_.reflectance_texture.id].host != nullptr;
    entry_.material.reflectance = Rgb(1);
    entry_.material.textures.push_back(use);
  }

 private:
  // Of the host's, which has no texels.
  bool is_hosts(const bdpt_texture_use& use, const Subject& subject) {
    const TextureEntry& texture = builder_.textures[use.texture.id];
    if (!texture.host) return false;
    const auto refuse = [&](const char* field, const char* why) {
      subject.refuse(field, "is set, but texture \"", texture.label(), "\" is the host's: ", why);
    };
    if (use.slot == BDPT_SLOT_OPACITY) refuse("slot", "rays ask for opacity one by one, so give an image for OPACITY");
    if (use.slot == BDPT_SLOT_EMISSION) refuse("slot", "lights are sampled by texels, so give an image for EMISSION");
    if (use.wrap[0] != 0 || use.wrap[1] != 0) refuse("wrap", "it gets coordinates as they are; set it to 0");
    if (use.lookup != 0) refuse("lookup", "it has no texels; set it to 0");
    if (use.level != 0) refuse("level", "it has no mip levels; set it to 0");
    return true;
  }
  int add(uint64_t id, const Subject& subject, const char* field, const SlotKind& kind) {
    const TextureEntry& texture = builder_.textures.at(id, (field + (" of " + subject.name())).c_str());
    if (kind.is_bounded && texture.maximum > 1)
      subject.refuse(field, "has ", texture.host ? "a maximum of " : "texels up to ", texture.maximum, " for slot ",
                     kind.name, ": a surface reflects no more than it receives; scale them to at most 1");
    if (kind.slot == Slot::Emission && !std::isfinite(norm(to_rgb(desc_.emission)) * texture.maximum))
      subject.refuse("texture", "has texels up to ", texture.maximum,
                     ", which times emission are no finite number: give less");
    entry_.textures.push_back(id);
    return int(entry_.textures.size()) - 1;
  }

  bdpt_builder& builder_;
  const Subject& material_;
  const bdpt_material_desc& desc_;
  MaterialEntry& entry_;
  uint32_t taken_ = 0;  // slots, one bit each
};

}  // namespace

void read_texture_uses(bdpt_builder& builder, const Subject& material, const bdpt_material_desc& desc,
                       MaterialEntry& entry) {
  UseReader reader(builder, material, desc, entry);
  material.check_range("texture_count", desc.texture_count, 0, kMaxUses);
  if (desc.texture_count > 0) {
    require(desc.textures, "desc.textures");
    check_stride(material, "texture_stride", desc.texture_stride, kVersion1Size<bdpt_texture_use>, 8);
    const uint32_t stride =
        desc.texture_stride ? desc.texture_stride : read_struct(desc.textures, "textures[0]").struct_size;
    if (stride % 8 != 0)
      material.refuse("texture_stride", "is 0 and struct_size of the first use ", stride, ": give a multiple of 8");
    for (uint32_t i = 0; i < desc.texture_count; ++i) {
      const std::string name = "textures[" + std::to_string(i) + "]";
      reader.read(read_struct(&element(desc.textures, i, stride), name.c_str()),
                  Subject((name + " of " + material.name()).c_str(), nullptr));
    }
  }
  if (desc.reflectance_texture.id != 0) reader.read_reflectance();
  if (desc.iridescence_thickness_minimum != 0 && !reader.has(BDPT_SLOT_IRIDESCENCE_THICKNESS))
    material.refuse(
        "iridescence_thickness_minimum", "is ", desc.iridescence_thickness_minimum,
        ", but no texture goes from it to iridescence_thickness: give one of slot IRIDESCENCE_THICKNESS, or 0");
}

}  // namespace bdpt
