// SPDX-License-Identifier: Apache-2.0
#include "gltf/materials.h"

namespace bdpt_tool::gltf {
namespace {

// A material that none names: a rough metal.
MaterialDescription default_material() {
  MaterialDescription material;
  material.type = BDPT_MATERIAL_PRINCIPLED;
  material.reflectance = {1, 1, 1};
  material.principled.metallic.factor = 1;
  material.one_sided = true;
  return material;
}

AnyImage read_image_of(const Document& document, int texture, const Location& where) {
  const auto slot = static_cast<std::size_t>(texture);
  const Texture& from = document.textures[slot];
  if (from.image < 0) {
    if (from.unread.empty()) throw Error(where, place("textures", slot) + " has no image; add one in PNG or JPEG");
    throw Error(where, place("textures", slot) + " has its image by " + from.unread +
                           " alone, which is not read here; write the textures as PNG or JPEG");
  }
  const Image& image = document.images[static_cast<std::size_t>(from.image)];
  if (!image.path.empty()) return read_image(image.path, where);
  const std::string_view data(reinterpret_cast<const char*>(image.data), image.size);
  return decode_image(place("images", static_cast<std::size_t>(from.image), image.name), data, where);
}

}  // namespace

int MaterialTable::use(int material, bool colored) {
  const auto [found, added] = materials_.emplace(std::pair(material, colored), -1);
  if (!added) return found->second;
  MaterialDescription description = converted(material, colored);
  found->second = static_cast<int>(scene_.materials.size());
  scene_.materials.push_back(std::move(description));
  return found->second;
}

MaterialDescription MaterialTable::converted(int material, bool colored) {
  MaterialDescription to;
  std::string where = "the default material";
  if (material < 0) {
    to = default_material();
  } else {
    to = document_.materials[static_cast<std::size_t>(material)];
    where = place("materials", static_cast<std::size_t>(material), to.label);
  }
  if (to.label.empty()) to.label = where;
  to.where = {scene_.path, 0};
  to.uses_vertex_colors = colored;
  if (to.unlit) notes_.add("unlit materials emit their colour, and are not lit", where);
  use_textures(to, where);
  return to;
}

void MaterialTable::use_textures(MaterialDescription& material, const std::string& place) {
  PrincipledDescription& p = material.principled;
  for (TextureUse* color :
       {&material.reflectance_texture, &material.emission_texture, &p.specular_color.texture, &p.sheen_color.texture,
        &material.alpha.texture, &p.specular.texture, &p.sheen_roughness.texture}) {
    // The last three are alphas, which no curve touches, of images whose other channels are colours.
    color->texture = texture(color->texture, true);
  }
  for (FloatValue* value :
       {&p.metallic, &p.roughness, &p.transmission, &p.thickness, &p.clearcoat, &p.clearcoat_roughness,
        &p.clearcoat_normal, &p.iridescence, &p.iridescence_thickness, &p.anisotropy, &material.normal}) {
    value->texture.texture = texture(value->texture.texture, false);
  }
  for (const TextureUse* use : {&material.reflectance_texture, &material.emission_texture, &material.normal.texture}) {
    if (use->texture >= 0 && use->uv_set > 1) {
      notes_.add("only the first two sets of texture coordinates are read", place);
    }
  }
}

int MaterialTable::texture(int texture, bool is_color) {
  if (texture < 0) return -1;
  const auto [found, added] = textures_.emplace(std::pair(texture, is_color), static_cast<int>(scene_.textures.size()));
  if (!added) return found->second;
  const Texture& from = document_.textures[static_cast<std::size_t>(texture)];
  TextureDescription to;
  to.where = {scene_.path, 0};
  to.image = read_image_of(document_, texture, to.where);
  const Image& image = document_.images[static_cast<std::size_t>(from.image)];
  to.label = place("images", static_cast<std::size_t>(from.image), image.name);
  to.exponent = is_color ? 0 : 1;
  to.wrap = from.wrap;
  to.nearest = from.nearest;
  scene_.textures.push_back(std::move(to));
  return found->second;
}

}  // namespace bdpt_tool::gltf
