// Executes the directives of a pbrt scene: transforms, attributes, names, instances.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "pbrt/lexer.h"
#include "pbrt/lights.h"
#include "pbrt/materials.h"
#include "pbrt/media.h"
#include "pbrt/motion.h"
#include "pbrt/shapes.h"
#include "pbrt/textures.h"
#include "scene_description.h"
#include "transform.h"

namespace bdpt_tool {

class Directives {
 public:
  Directives(SceneDescription& scene, Diagnostics& diagnostics, const SceneFolder& folder);

  // Executes one directive, whose name has just been read. Include and Import are not among them.
  void execute(const Token& name, Lexer& lexer);

  // At the end of the last file.
  void finish(const Location& end);

  // An imported file leaves the attributes of its importer as they are.
  void begin_import(const Location& where);
  void end_import(const Location& where);

 private:
  // A material is converted when a shape is seen to use it; one that is never used needs no support.
  struct MaterialEntry {
    std::string name, type;
    ParamList params;
    bool defined = false;
    std::optional<MaterialDescription> converted;
  };
  struct State {
    MovingTransform transform;
    std::array<bool, 2> active = {true, true};  // which of them transforms change: start and end
    std::shared_ptr<MaterialEntry> material;
    std::optional<AreaLight> area_light;
    bool reverse_orientation = false;
    std::string interior, exterior;  // media by name
  };
  struct PlacedShape {
    int shape = 0;
    State state;
    Location where;
    FloatValue alpha = {};
  };
  struct Scope {
    enum class Kind { kAttribute, kTransform, kObject, kImport } kind;
    State state;
    Location where;
  };

  using Handler = void (Directives::*)(Lexer&, const Location&);
  static const std::map<std::string_view, Handler>& handlers();

  // directives_transform.cpp
  void identity(Lexer&, const Location&);
  void translate(Lexer&, const Location&);
  void scale(Lexer&, const Location&);
  void rotate(Lexer&, const Location&);
  void look_at_directive(Lexer&, const Location&);
  void transform(Lexer&, const Location&);
  void concat_transform(Lexer&, const Location&);
  void coordinate_system(Lexer&, const Location&);
  void coord_sys_transform(Lexer&, const Location&);
  void active_transform(Lexer&, const Location&);
  void transform_times(Lexer&, const Location&);
  template <class Change>
  void change_transform(const Change& change, const Location& where);

  // directives.cpp
  void camera(Lexer&, const Location&);
  void film(Lexer&, const Location&);
  void pixel_filter(Lexer&, const Location&);
  void sampler(Lexer&, const Location&);
  void integrator(Lexer&, const Location&);
  void accelerator(Lexer&, const Location&);
  void option(Lexer&, const Location&);
  void color_space(Lexer&, const Location&);
  void medium_interface(Lexer&, const Location&);
  void make_named_medium(Lexer&, const Location&);
  void attribute(Lexer&, const Location&);
  void world_begin(Lexer&, const Location&);
  void require_options(const Location& where, const char* name) const;
  void require_world(const Location& where, const char* name) const;

  // directives_world.cpp
  void attribute_begin(Lexer&, const Location&);
  void attribute_end(Lexer&, const Location&);
  void transform_begin(Lexer&, const Location&);
  void transform_end(Lexer&, const Location&);
  void object_begin(Lexer&, const Location&);
  void object_end(Lexer&, const Location&);
  void object_instance(Lexer&, const Location&);
  void reverse_orientation(Lexer&, const Location&);
  void texture(Lexer&, const Location&);
  void material(Lexer&, const Location&);
  void make_named_material(Lexer&, const Location&);
  void named_material(Lexer&, const Location&);
  void area_light_source(Lexer&, const Location&);
  void light_source(Lexer&, const Location&);
  void shape(Lexer&, const Location&);
  void pop(Scope::Kind kind, const Location& where);
  std::shared_ptr<MaterialEntry> material_named(const std::string& name);
  const MaterialDescription& converted(MaterialEntry& entry, const Location& user, int depth = 0);
  MaterialDescription mixed(MaterialEntry& entry, const Location& user, int depth);
  FloatValue alpha_of(const ParamList& params);
  int place_material(const PlacedShape& placed);
  MovingTransform transform_of(const PlacedShape& placed, bool emits);
  void place(const PlacedShape& placed);
  int medium_named(const std::string& name, const Location& user) const;

  SceneDescription& scene_;
  Diagnostics& diagnostics_;
  const SceneFolder& folder_;
  TextureTable textures_;
  ShapeTable shapes_;
  State state_;
  std::vector<Scope> scopes_;
  bool in_world_ = false;
  bool has_camera_ = false;
  TimeRange transform_times_ = {0, 1}, shutter_ = {0, 1};
  std::map<std::string, MovingTransform> coordinate_systems_;
  std::map<std::string, std::shared_ptr<MaterialEntry>> named_materials_;
  std::map<std::string, int> named_media_;
  std::string camera_medium_;
  Location camera_where_;
  std::map<std::string, std::vector<PlacedShape>> objects_;
  std::string open_object_;
  std::vector<PlacedShape> placed_;
  // Turned over, emits on both sides, emission and its texture; what is inside; factor and texture of alpha.
  using MaterialKey = std::tuple<const MaterialEntry*, bool, bool, Rgb, int, int, float, int, std::array<float, 6>>;
  std::map<MaterialKey, int> placed_materials_;
};

// Helpers of the directives: the next token must be a string or a number.
std::string expect_string(Lexer& lexer, const Location& where, const char* what);
double expect_number(Lexer& lexer, const Location& where, const char* directive);
// A string that names a type, then parameters; `type` receives the string.
ParamList expect_params(Lexer& lexer, const Location& where, const char* directive, std::string& type);

}  // namespace bdpt_tool
