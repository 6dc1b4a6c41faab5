// The parameter list of a directive: "type name" [values] ...
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "error.h"
#include "pbrt/lexer.h"

namespace bdpt_tool {

using Rgb = std::array<float, 3>;

struct Param {
  std::string type;
  std::string name;
  std::vector<double> numbers;
  std::vector<std::string> strings;
  Location where;
  mutable bool used = false;
};

class ParamList {
 public:
  ParamList() = default;
  // `directive` names the list in errors, such as: Shape "sphere".
  ParamList(std::string directive, Location where) : directive_(std::move(directive)), where_(std::move(where)) {}

  // Reads parameters until the next directive or the end of the file.
  void parse(Lexer& lexer);

  const std::string& directive() const { return directive_; }
  const Location& where() const { return where_; }
  void set_directive(std::string directive) { directive_ = std::move(directive); }

  // Each get marks the parameter as used; one of another type or length is an error.
  const Param* find(const std::string& name) const;
  bool has(const std::string& name) const { return find(name) != nullptr; }
  float get_float(const std::string& name, float fallback) const;
  int get_int(const std::string& name, int fallback) const;
  bool get_bool(const std::string& name, bool fallback) const;
  std::string get_string(const std::string& name, const std::string& fallback) const;
  std::string get_texture(const std::string& name) const;  // the texture's name, empty if it is none
  Rgb get_point(const std::string& name, const Rgb& fallback) const;
  // "rgb", or what spectra.h makes of "spectrum" and, for a light, of "blackbody".
  Rgb get_rgb(const std::string& name, const Rgb& fallback, bool light = false) const;
  std::vector<float> get_floats(const std::string& name) const;
  // Of type point2, point3, vector3 or normal (or the names without digits); all finite; a whole number of tuples.
  std::vector<float> get_tuples(const std::string& name, std::size_t size) const;
  std::vector<std::uint32_t> get_indices(const std::string& name) const;

  // Throws if the parameter is there; `what` says what to do.
  void refuse(const std::string& name, const std::string& what) const;
  // The parameter is known, and changes nothing here.
  void ignore(const std::string& name) const { find(name); }
  void warn_ignored(const std::string& name, const std::string& why, Diagnostics& diagnostics) const;
  void warn_unused(Diagnostics& diagnostics) const;

  [[noreturn]] void fail(const std::string& text) const { throw Error(where_, directive_ + ": " + text); }
  [[noreturn]] void fail(const Param& param, const std::string& text) const;

 private:
  Param parse_one(Lexer& lexer, const Token& declaration) const;
  const Param* find_typed(const std::string& name, std::initializer_list<const char*> types, std::size_t count) const;

  std::string directive_;
  Location where_;
  std::vector<Param> params_;
};

}  // namespace bdpt_tool
