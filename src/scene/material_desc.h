// A material as the builder hands it over: its numbers, and the textures that vary them over a surface.
#pragma once

#include "geometry/opacity.h"
#include "material/material.h"

#include <memory>
#include <vector>

namespace bdpt {

// What a texture varies. A colour is multiplied by the texture's, a number by one of its channels.
enum class Slot : uint8_t {
  Reflectance,
  Roughness,  // along u and v
  Normal,     // a tangent-space normal map: 2 rgb - 1, x along u, y along v
  Bump,       // a height along the normal, in the texture's channel times the use's scale, in world units
  Emission,
  DiffuseRoughness,
  Transmittance,
  Metalness,
  Specular,
  SpecularColor,
  Coat,
  CoatRoughness,
  Sheen,
  SheenRoughness,
  Transmission,
  DiffuseTransmission,
  Anisotropy,  // red and green the direction, 2 rg - 1; blue the number
  Mix,
  Film,
  FilmThickness,  // between the least and the material's own
};

struct TextureUse {
  int texture = 0;  // index into SceneDesc::textures, or host_textures
  bool is_hosts = false;
  uint32_t answer = 0;  // of the host's: which of its material's answers is its first
  Slot slot = Slot::Reflectance;
  uint8_t channel = 0;
  bool squared = false;  // the texture's number counts by its square
  float scale = 1;       // of a normal's x and y, and of heights
  UvMap uv;
  TextureSampler sampler;
};

struct MaterialDesc : Material {
  MaterialDesc() = default;
  MaterialDesc(const Material& material) : Material(material) {}

  std::vector<TextureUse> textures;
  Opacity opacity;
  float least_film_thickness = 0;
  int interior = -1;        // index into SceneDesc::media: what its closed surfaces enclose
  uint32_t priority = 0;    // where they overlap others
  int mixed[2] = {-1, -1};  // of a mix: indices into SceneDesc::materials
  std::shared_ptr<const HostMaterial> host_owner;
  uint32_t answers = 0;  // of the host's textures, for each hit; see HostLookups

  // Whether a copy of the numbers is needed at each point; the reflectance is the vertex's own.
  bool varies() const {
    for (const TextureUse& use : textures)
      if (use.slot != Slot::Reflectance && use.slot != Slot::Normal && use.slot != Slot::Bump &&
          use.slot != Slot::Emission)
        return true;
    return false;
  }
};

}  // namespace bdpt
