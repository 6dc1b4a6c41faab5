// SPDX-License-Identifier: Apache-2.0
#include "pbrt/directives.h"

#include <charconv>
#include <utility>

#include "pbrt/cameras.h"
#include "pbrt/render_options.h"

namespace bdpt_tool {

std::string expect_string(Lexer& lexer, const Location& where, const char* what) {
  const std::optional<Token> token = lexer.next();
  if (!token || token->kind != Token::Kind::kString) throw Error(where, std::string("expected ") + what + " in quotes");
  return token->string();
}

double expect_number(Lexer& lexer, const Location& where, const char* directive) {
  const std::optional<Token> token = lexer.next();
  double value = 0;
  if (token && token->kind == Token::Kind::kWord) {
    const char* begin = token->text.data();
    const char* end = begin + token->text.size();
    if (*begin == '+') ++begin;
    const auto result = std::from_chars(begin, end, value);
    if (result.ec == std::errc() && result.ptr == end) return value;
    if (result.ec == std::errc::result_out_of_range) return 0;
  }
  throw Error(where, std::string(directive) + ": expected a number" +
                         (token ? ", found '" + std::string(token->text) + "'" : std::string()));
}

ParamList expect_params(Lexer& lexer, const Location& where, const char* directive, std::string& type) {
  type = expect_string(lexer, where, (std::string(directive) + ": a type").c_str());
  ParamList params(std::string(directive) + " \"" + type + "\"", where);
  params.parse(lexer);
  return params;
}

Directives::Directives(SceneDescription& scene, Diagnostics& diagnostics, const SceneFolder& folder)
    : scene_(scene),
      diagnostics_(diagnostics),
      folder_(folder),
      textures_(scene, diagnostics, folder),
      shapes_(scene, diagnostics, folder) {
  state_.material = std::make_shared<MaterialEntry>();
  state_.material->type = "diffuse";
  state_.material->defined = true;
}

const std::map<std::string_view, Directives::Handler>& Directives::handlers() {
  using D = Directives;
  static const std::map<std::string_view, Handler> handlers = {
      {"Identity", &D::identity},
      {"Translate", &D::translate},
      {"Scale", &D::scale},
      {"Rotate", &D::rotate},
      {"LookAt", &D::look_at_directive},
      {"Transform", &D::transform},
      {"ConcatTransform", &D::concat_transform},
      {"CoordinateSystem", &D::coordinate_system},
      {"CoordSysTransform", &D::coord_sys_transform},
      {"ActiveTransform", &D::active_transform},
      {"TransformTimes", &D::transform_times},
      {"Camera", &D::camera},
      {"Film", &D::film},
      {"PixelFilter", &D::pixel_filter},
      {"Sampler", &D::sampler},
      {"Integrator", &D::integrator},
      {"Accelerator", &D::accelerator},
      {"Option", &D::option},
      {"ColorSpace", &D::color_space},
      {"MediumInterface", &D::medium_interface},
      {"MakeNamedMedium", &D::make_named_medium},
      {"Attribute", &D::attribute},
      {"WorldBegin", &D::world_begin},
      {"AttributeBegin", &D::attribute_begin},
      {"AttributeEnd", &D::attribute_end},
      {"TransformBegin", &D::transform_begin},
      {"TransformEnd", &D::transform_end},
      {"ObjectBegin", &D::object_begin},
      {"ObjectEnd", &D::object_end},
      {"ObjectInstance", &D::object_instance},
      {"ReverseOrientation", &D::reverse_orientation},
      {"Texture", &D::texture},
      {"Material", &D::material},
      {"MakeNamedMaterial", &D::make_named_material},
      {"NamedMaterial", &D::named_material},
      {"AreaLightSource", &D::area_light_source},
      {"LightSource", &D::light_source},
      {"Shape", &D::shape},
  };
  return handlers;
}

void Directives::execute(const Token& name, Lexer& lexer) {
  const Location where = lexer.location(name.line);
  const auto found = handlers().find(name.text);
  if (name.kind != Token::Kind::kWord || found == handlers().end()) {
    throw Error(where, "unknown directive '" + std::string(name.text) + "'; this program reads the pbrt-v4 format");
  }
  (this->*found->second)(lexer, where);
}

void Directives::require_options(const Location& where, const char* name) const {
  if (in_world_) throw Error(where, std::string(name) + " must come before WorldBegin");
}

void Directives::require_world(const Location& where, const char* name) const {
  if (!in_world_) throw Error(where, std::string(name) + " must come after WorldBegin");
}

void Directives::camera(Lexer& lexer, const Location& where) {
  require_options(where, "Camera");
  std::string type;
  const ParamList params = expect_params(lexer, where, "Camera", type);
  read_camera(type, params, state_.transform, transform_times_, shutter_, folder_, scene_, diagnostics_);
  coordinate_systems_["camera"] = state_.transform.inverse();
  camera_medium_ = state_.exterior;
  camera_where_ = where;
  has_camera_ = true;
}

void Directives::film(Lexer& lexer, const Location& where) {
  require_options(where, "Film");
  std::string type;
  const ParamList params = expect_params(lexer, where, "Film", type);
  read_film(type, params, scene_, diagnostics_);
}

void Directives::pixel_filter(Lexer& lexer, const Location& where) {
  require_options(where, "PixelFilter");
  std::string type;
  const ParamList params = expect_params(lexer, where, "PixelFilter", type);
  read_filter(type, params, scene_, diagnostics_);
}

void Directives::sampler(Lexer& lexer, const Location& where) {
  require_options(where, "Sampler");
  std::string type;
  const ParamList params = expect_params(lexer, where, "Sampler", type);
  read_sampler(type, params, scene_, diagnostics_);
}

void Directives::integrator(Lexer& lexer, const Location& where) {
  require_options(where, "Integrator");
  std::string type;
  const ParamList params = expect_params(lexer, where, "Integrator", type);
  read_integrator(type, params, scene_, diagnostics_);
}

void Directives::accelerator(Lexer& lexer, const Location& where) {
  require_options(where, "Accelerator");
  std::string type;
  expect_params(lexer, where, "Accelerator", type);
}

void Directives::option(Lexer& lexer, const Location& where) {
  ParamList params("Option", where);
  params.parse(lexer);
  for (const char* name : {"rendercoordsys", "seed", "pixelstats", "wavefront", "forcediffuse"}) params.ignore(name);
  params.refuse("disabletexturefiltering", "is not known; remove it");
  params.warn_unused(diagnostics_);
}

void Directives::color_space(Lexer& lexer, const Location& where) {
  const std::string name = expect_string(lexer, where, "ColorSpace: a name");
  if (name != "srgb") throw Error(where, "the colour space '" + name + "' is not known; convert the colours to srgb");
}

void Directives::medium_interface(Lexer& lexer, const Location& where) {
  state_.interior = state_.exterior = expect_string(lexer, where, "MediumInterface: a name");
  const auto token = lexer.peek();
  if (token && token->kind == Token::Kind::kString) state_.exterior = lexer.next()->string();
}

void Directives::make_named_medium(Lexer& lexer, const Location& where) {
  std::string name;
  const ParamList params = expect_params(lexer, where, "MakeNamedMedium", name);
  if (!named_media_.emplace(name, static_cast<int>(scene_.media.size())).second) {
    throw Error(where, "the medium '" + name + "' is defined twice; rename one");
  }
  scene_.media.push_back(convert_medium(name, params, diagnostics_));
}

void Directives::attribute(Lexer&, const Location& where) {
  throw Error(where, "Attribute is not known yet; give the parameters to each shape, light or material");
}

void Directives::world_begin(Lexer&, const Location& where) {
  require_options(where, "WorldBegin");
  in_world_ = true;
  state_.transform = MovingTransform{};
  state_.active = {true, true};
  coordinate_systems_["world"] = MovingTransform{};
}

}  // namespace bdpt_tool
