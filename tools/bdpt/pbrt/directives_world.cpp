// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <utility>

#include "pbrt/directives.h"

namespace bdpt_tool {
namespace {

const char* begin_name(int kind) {
  static constexpr const char* kNames[] = {"AttributeBegin", "TransformBegin", "ObjectBegin", "Import"};
  return kNames[kind];
}

const char* end_name(int kind) {
  static constexpr const char* kNames[] = {"AttributeEnd", "TransformEnd", "ObjectEnd", "the end of the import"};
  return kNames[kind];
}

}  // namespace

void Directives::pop(Scope::Kind kind, const Location& where) {
  if (scopes_.empty()) {
    throw Error(where, std::string(end_name(int(kind))) + " without " + begin_name(int(kind)));
  }
  const Scope scope = std::move(scopes_.back());
  scopes_.pop_back();
  if (scope.kind != kind) {
    throw Error(where, std::string(end_name(int(kind))) + " closes the " + begin_name(int(scope.kind)) + " of line " +
                           std::to_string(scope.where.line) + "; close that first");
  }
  if (kind == Scope::Kind::kTransform) {
    state_.transform = scope.state.transform;
    state_.active = scope.state.active;
  } else {
    state_ = scope.state;
  }
}

void Directives::attribute_begin(Lexer&, const Location& where) {
  scopes_.push_back({Scope::Kind::kAttribute, state_, where});
}
void Directives::attribute_end(Lexer&, const Location& where) { pop(Scope::Kind::kAttribute, where); }

void Directives::transform_begin(Lexer&, const Location& where) {
  scopes_.push_back({Scope::Kind::kTransform, state_, where});
}
void Directives::transform_end(Lexer&, const Location& where) { pop(Scope::Kind::kTransform, where); }

void Directives::begin_import(const Location& where) { scopes_.push_back({Scope::Kind::kImport, state_, where}); }
void Directives::end_import(const Location& where) { pop(Scope::Kind::kImport, where); }

void Directives::object_begin(Lexer& lexer, const Location& where) {
  require_world(where, "ObjectBegin");
  const std::string name = expect_string(lexer, where, "ObjectBegin: a name");
  if (!open_object_.empty()) throw Error(where, "ObjectBegin inside the object '" + open_object_ + "'; end that first");
  if (name.empty()) throw Error(where, "ObjectBegin: the name is empty");
  if (!objects_.emplace(name, std::vector<PlacedShape>()).second) {
    throw Error(where, "the object '" + name + "' is defined twice; rename one");
  }
  scopes_.push_back({Scope::Kind::kObject, state_, where});
  open_object_ = name;
}

void Directives::object_end(Lexer&, const Location& where) {
  pop(Scope::Kind::kObject, where);
  open_object_.clear();
}

void Directives::object_instance(Lexer& lexer, const Location& where) {
  require_world(where, "ObjectInstance");
  const std::string name = expect_string(lexer, where, "ObjectInstance: a name");
  if (!open_object_.empty()) throw Error(where, "ObjectInstance inside an object is not allowed");
  const auto found = objects_.find(name);
  if (found == objects_.end()) throw Error(where, "there is no object '" + name + "'; define it with ObjectBegin");
  for (PlacedShape placed : found->second) {
    placed.state.transform = state_.transform * placed.state.transform;
    placed.where = where;
    placed_.push_back(std::move(placed));
  }
}

void Directives::reverse_orientation(Lexer&, const Location& where) {
  require_world(where, "ReverseOrientation");
  state_.reverse_orientation = !state_.reverse_orientation;
}

void Directives::texture(Lexer& lexer, const Location& where) {
  require_world(where, "Texture");
  const std::string name = expect_string(lexer, where, "Texture: a name");
  const std::string type = expect_string(lexer, where, "Texture: a type");
  if (type != "spectrum" && type != "float")
    throw Error(where, "a texture is \"spectrum\" or \"float\", not \"" + type + "\"");
  std::string kind;
  ParamList params = expect_params(lexer, where, "Texture", kind);
  params.set_directive("Texture \"" + name + "\" \"" + kind + "\"");
  textures_.define(name, kind, type == "float", std::move(params));
}

std::shared_ptr<Directives::MaterialEntry> Directives::material_named(const std::string& name) {
  auto& entry = named_materials_[name];
  if (!entry) {
    entry = std::make_shared<MaterialEntry>();
    entry->name = name;
  }
  return entry;
}

void Directives::material(Lexer& lexer, const Location& where) {
  require_world(where, "Material");
  auto entry = std::make_shared<MaterialEntry>();
  entry->params = expect_params(lexer, where, "Material", entry->type);
  entry->name = entry->type;
  entry->defined = true;
  state_.material = std::move(entry);
}

void Directives::make_named_material(Lexer& lexer, const Location& where) {
  require_world(where, "MakeNamedMaterial");
  std::string name;
  ParamList params = expect_params(lexer, where, "MakeNamedMaterial", name);
  const auto entry = material_named(name);
  if (entry->defined) throw Error(where, "the material '" + name + "' is defined twice; rename one");
  entry->type = params.get_string("type", "");
  if (entry->type.empty()) params.fail("\"string type\" is missing");
  entry->params = std::move(params);
  entry->defined = true;
}

void Directives::named_material(Lexer& lexer, const Location& where) {
  require_world(where, "NamedMaterial");
  state_.material = material_named(expect_string(lexer, where, "NamedMaterial: a name"));
}

void Directives::area_light_source(Lexer& lexer, const Location& where) {
  require_world(where, "AreaLightSource");
  std::string type;
  const ParamList params = expect_params(lexer, where, "AreaLightSource", type);
  state_.area_light = convert_area_light(type, params, folder_, scene_, diagnostics_);
}

void Directives::light_source(Lexer& lexer, const Location& where) {
  require_world(where, "LightSource");
  std::string type;
  const ParamList params = expect_params(lexer, where, "LightSource", type);
  if (state_.transform.moves())
    diagnostics_.warn(where, params.directive() + ": lights do not move; it stays where it starts, as in pbrt");
  scene_.lights.push_back(convert_light(type, params, state_.transform.start, folder_, scene_, diagnostics_));
}

void Directives::shape(Lexer& lexer, const Location& where) {
  require_world(where, "Shape");
  std::string type;
  const ParamList params = expect_params(lexer, where, "Shape", type);
  const FloatValue alpha = alpha_of(params);
  PlacedShape placed{shapes_.add(type, params, state_.reverse_orientation), state_, where, alpha};
  if (open_object_.empty()) {
    placed_.push_back(std::move(placed));
    return;
  }
  if (placed.state.area_light) {
    diagnostics_.warn(where, "an area light inside an object does not shine, as in pbrt; place it outside");
    placed.state.area_light.reset();
  }
  objects_[open_object_].push_back(std::move(placed));
}

FloatValue Directives::alpha_of(const ParamList& params) {
  FloatValue alpha;
  const std::string texture = params.get_texture("alpha");
  if (texture.empty()) {
    alpha.factor = params.get_float("alpha", 1);
  } else {
    const TextureValue value = textures_.resolve(texture, params);
    alpha.factor = value.constant[0];
    alpha.texture = value.use;
  }
  if (!(alpha.factor >= 0 && alpha.factor <= 1)) params.fail("alpha must be between 0 and 1");
  return alpha;
}

const MaterialDescription& Directives::converted(MaterialEntry& entry, const Location& user, int depth) {
  if (!entry.defined) {
    throw Error(user, "there is no material '" + entry.name + "'; define it with MakeNamedMaterial");
  }
  if (!entry.converted) {
    entry.converted = entry.type == "mix" ? mixed(entry, user, depth)
                                          : convert_material(entry.type, entry.params, textures_, diagnostics_);
    entry.converted->label = entry.name;
  }
  return *entry.converted;
}

// The two are materials of the scene, too.
MaterialDescription Directives::mixed(MaterialEntry& entry, const Location& user, int depth) {
  constexpr int kMaxDepth = 16;
  const ParamList& params = entry.params;
  if (depth > kMaxDepth) params.fail("materials are mixed of each other more than 16 deep");
  MaterialDescription mix;
  mix.type = BDPT_MATERIAL_MIX;
  mix.where = params.where();
  const Param* names = params.find("materials");
  if (!names || names->type != "string" || names->strings.size() != 2) {
    params.fail("needs \"string materials\" with two names");
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const MaterialDescription part = converted(*material_named(names->strings[i]), user, depth + 1);
    mix.mixed[i] = static_cast<int>(scene_.materials.size());
    scene_.materials.push_back(part);
  }
  const std::string texture = params.get_texture("amount");
  mix.mix_amount.factor = texture.empty() ? params.get_float("amount", 0.5f) : 1;
  if (!texture.empty()) {
    const TextureValue value = textures_.resolve(texture, params);
    mix.mix_amount = {value.constant[0], value.use, 0};
  }
  if (!(mix.mix_amount.factor >= 0 && mix.mix_amount.factor <= 1)) params.fail("amount must be between 0 and 1");
  params.warn_unused(diagnostics_);
  return mix;
}

int Directives::medium_named(const std::string& name, const Location& user) const {
  if (name.empty()) return -1;
  const auto found = named_media_.find(name);
  if (found == named_media_.end()) {
    throw Error(user, "there is no medium '" + name + "'; define it with MakeNamedMedium");
  }
  return found->second;
}

// One material for each pair of a material of the file and an emission. Turning a sphere over, which the library
// cannot, comes to the inverse index for glass and to nothing for what does not emit.
int Directives::place_material(const PlacedShape& placed) {
  MaterialEntry& entry = *placed.state.material;
  MaterialDescription material = converted(entry, placed.where);
  if (const auto& light = placed.state.area_light) {
    material.emission = light->radiance;
    material.emission_texture.texture = light->texture;
    material.emission_two_sided = light->two_sided;
  }
  if (placed.alpha.factor < 1 || placed.alpha.texture.texture >= 0) {
    if (!material.emits()) {
      material.alpha_mode = AlphaMode::kBlend;
      material.alpha = placed.alpha;
    } else if (placed.alpha.factor == 0) {
      diagnostics_.warn(placed.where, "alpha of a shape that emits is left out: it is seen, and in pbrt shines unseen");
    } else {
      diagnostics_.warn(placed.where, "alpha of a shape that emits is left out: all of it is there, and shines");
    }
  }
  const bool sphere = std::holds_alternative<SphereShape>(scene_.shapes[placed.shape].geometry);
  const bool turned = sphere && placed.state.reverse_orientation;
  if (turned && material.emits() && !material.emission_two_sided) {
    throw Error(placed.where, "a sphere that emits to its inside is not known; use a mesh");
  }
  if (turned) material.ior = 1 / material.ior;
  if (sphere && material.reflectance_texture.texture >= 0) {
    diagnostics_.warn(placed.where, "the texture may lie differently on a sphere than in pbrt");
  }
  if (material.type == BDPT_MATERIAL_DIELECTRIC || material.type == BDPT_MATERIAL_INTERFACE)
    material.interior = medium_named(placed.state.interior, placed.where);
  const MaterialKey key(&entry, turned, material.emission_two_sided, material.emission,
                        material.emission_texture.texture, material.interior, placed.alpha.factor,
                        placed.alpha.texture.texture, placed.alpha.texture.transform);
  const auto [found, added] = placed_materials_.emplace(key, static_cast<int>(scene_.materials.size()));
  if (added) scene_.materials.push_back(std::move(material));
  return found->second;
}

// While the shutter is open; and tells of what the library cannot do.
MovingTransform Directives::transform_of(const PlacedShape& placed, bool emits) {
  constexpr double kMostShrinkage = 1e-3;  // by turns of 5 degrees
  MovingTransform transform = placed.state.transform;
  for (const Transform& end : {transform.start, transform.end}) {
    if (!end.is_finite() || !end.is_invertible()) {
      throw Error(placed.where,
                  "the transform of this shape is singular or not finite; check the directives before it");
    }
    if (std::holds_alternative<SphereShape>(scene_.shapes[placed.shape].geometry) && uniform_scale(end) == 0) {
      throw Error(placed.where,
                  "this transform makes an ellipsoid of a sphere; scale alike in all axes, or use a mesh");
    }
  }
  if (!transform.moves()) return transform;
  if (emits) {
    diagnostics_.warn(placed.where, "what emits does not move here; it stays where it starts");
    return {transform.start, transform.start};
  }
  if (std::holds_alternative<SphereShape>(scene_.shapes[placed.shape].geometry)) {
    // That a sphere turns is not seen; turning on straight lines would flatten it.
    const double growth = uniform_scale(transform.end) / uniform_scale(transform.start);
    for (int i = 0; i < 9; ++i) transform.end.m[i / 3][i % 3] = growth * transform.start.m[i / 3][i % 3];
  }
  transform = shape_in_shutter(transform, transform_times_, shutter_);
  if (!transform.moves()) return transform;
  if (rests_in_shutter(transform_times_, shutter_)) {
    diagnostics_.warn(placed.where,
                      "moves during a part of the exposure alone; here it moves as far, evenly, during all of it. Let "
                      "TransformTimes be shutteropen and shutterclose of the Camera");
  }
  if (const double part = shrinkage(transform); part > kMostShrinkage) {
    diagnostics_.warn(placed.where,
                      "turns so far that it gets " + std::to_string(100 * part) +
                          " % smaller on the way: its points move on straight lines here, not on circles");
  }
  return transform;
}

void Directives::place(const PlacedShape& placed) {
  const int material = place_material(placed);
  const bool emits = scene_.materials[static_cast<std::size_t>(material)].emits();
  const MovingTransform transform = transform_of(placed, emits);
  const std::string& label = scene_.shapes[static_cast<std::size_t>(placed.shape)].label;
  InstanceDescription instance;
  instance.shape = placed.shape;
  instance.material = material;
  instance.transform = transform.start.rows();
  if (transform.moves()) instance.end_transform = transform.end.rows();
  instance.where = placed.where;
  instance.label = label;
  instance.node = scene_.instances.size();
  instance.node_name = std::filesystem::path(label).filename().string();
  scene_.instances.push_back(std::move(instance));
}

void Directives::finish(const Location& end) {
  if (!scopes_.empty()) {
    const Scope& scope = scopes_.back();
    throw Error(scope.where,
                std::string(begin_name(int(scope.kind))) + " is never closed; add " + end_name(int(scope.kind)));
  }
  if (!in_world_) throw Error(end, "there is no WorldBegin; this is no complete pbrt-v4 scene");
  if (!has_camera_) diagnostics_.warn(end, "there is no Camera; one at the origin that looks along +z is used");
  shapes_.read_files();
  scene_.medium = medium_named(camera_medium_, camera_where_);
  scene_.instances.reserve(placed_.size());
  for (const PlacedShape& placed : placed_) place(placed);
  if (scene_.instances.empty() && scene_.lights.empty()) throw Error(end, "the scene is empty; it needs a Shape");
}

}  // namespace bdpt_tool
