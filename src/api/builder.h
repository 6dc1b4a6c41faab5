// The builder: what the host has added so far, validated, by id.
#pragma once

#include "api/busy.h"
#include "api/handles.h"
#include "api/table.h"
#include "geometry/curves.h"
#include "geometry/host_texture.h"
#include "geometry/mesh.h"
#include "geometry/texture.h"
#include "light/light_desc.h"
#include "math/transform.h"
#include "medium/medium.h"
#include "scene/material_desc.h"

#include <memory>
#include <string>

namespace bdpt {

// users counts who refers to an entry; it is removed only at zero.
struct ShapeEntry {
  Shape shape;
  Vec3 extent{0, 0, 0};  // the greatest absolute coordinate along each axis
  uint64_t users = 0;
  bool is_sphere() const { return shape.sphere != nullptr; }
  const std::string& label() const {
    return shape.mesh ? shape.mesh->label : shape.curves ? shape.curves->label : shape.sphere->label;
  }
};

// An image, or the host's function.
struct TextureEntry {
  std::shared_ptr<const Texture> texture;
  std::shared_ptr<const HostTexture> host;
  float maximum = 0;  // of all channels
  uint64_t users = 0;
  const std::string& label() const { return host ? host->label : texture->label(); }
};

struct MaterialEntry {
  std::string label;
  MaterialDesc material;           // its textures are indices into the following until a scene is built
  std::vector<uint64_t> textures;  // ids
  uint64_t medium = 0;             // of the interior: id, or zero
  uint64_t parts[2] = {};          // ids, of a mix
  uint64_t users = 0;              // instances and mixes
  uint64_t mixes = 0;              // of these
};

struct MediumEntry {
  std::shared_ptr<const Medium> medium;
  uint64_t users = 0;
};

struct LightEntry {
  LightDesc light;       // its texture is set when a scene is built
  uint64_t texture = 0;  // id, or zero
};

struct InstanceEntry {
  std::string label;
  uint64_t shape = 0, material = 0;    // ids
  Transform transform = {}, end = {};  // end: at time 1, of what moves
  bool moves = false;
  bool invisible = false;
};

}  // namespace bdpt

struct bdpt_builder {
  bdpt_builder(bdpt_context* context_, uint64_t tag)
      : context(context_),
        shapes(bdpt::IdKind::Shape, "shape", tag),
        textures(bdpt::IdKind::Texture, "texture", tag),
        materials(bdpt::IdKind::Material, "material", tag),
        lights(bdpt::IdKind::Light, "light", tag),
        instances(bdpt::IdKind::Instance, "instance", tag),
        media(bdpt::IdKind::Medium, "medium", tag) {}

  bdpt::Ref<bdpt_context> context;
  bdpt::Table<bdpt::ShapeEntry> shapes;
  bdpt::Table<bdpt::TextureEntry> textures;
  bdpt::Table<bdpt::MaterialEntry> materials;
  bdpt::Table<bdpt::LightEntry> lights;
  bdpt::Table<bdpt::InstanceEntry> instances;
  bdpt::Table<bdpt::MediumEntry> media;
  bdpt::Busy busy;
};

namespace bdpt {

// The builder, if it may be changed now.
inline bdpt_builder& writable(bdpt_builder* builder) {
  require(builder, "builder").busy.check("builder");
  return *builder;
}

// Throws InUse while someone refers to the object.
inline void check_unused(uint64_t users, const char* kind, const std::string& label, const char* by) {
  if (users == 0) return;
  fail(ErrorCode::InUse, kind, label.empty() ? "" : " \"" + label + '"', " is used by ", users, ' ', by,
       users == 1 ? "" : "s", ": remove or update these first");
}

}  // namespace bdpt
