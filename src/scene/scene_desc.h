// What a scene is made of, as the builder hands it over: validated, with indices in place of ids.
#pragma once

#include "geometry/host_texture.h"
#include "geometry/mesh.h"
#include "geometry/texture.h"
#include "light/light_desc.h"
#include "math/transform.h"
#include "medium/medium.h"
#include "scene/material_desc.h"

#include <memory>
#include <string>
#include <vector>

namespace bdpt {

struct InstanceDesc {
  std::string label;
  int shape = 0;     // index into SceneDesc::shapes
  int material = 0;  // index into SceneDesc::materials
  Transform transform;
  Transform end;  // at time 1, of what moves
  bool moves = false;
  uint64_t id = 0;           // the host's, by which sensors name it; decides nothing
  uint64_t material_id = 0;  // the same of its material
  bool invisible = false;    // no ray meets it; sensors may lie on it
};

struct SceneDesc {
  std::vector<Shape> shapes;
  std::vector<std::shared_ptr<const Texture>> textures;
  std::vector<std::shared_ptr<const HostTexture>> host_textures;
  std::vector<MaterialDesc> materials;
  std::vector<std::shared_ptr<const Medium>> media;
  int outside = -1;               // the medium outside of all that encloses one
  std::vector<LightDesc> lights;  // those that are no instances
  std::vector<InstanceDesc> instances;
};

}  // namespace bdpt
