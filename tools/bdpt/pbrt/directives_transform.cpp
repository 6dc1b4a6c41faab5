// SPDX-License-Identifier: Apache-2.0
#include "pbrt/directives.h"

namespace bdpt_tool {
namespace {

Vec3 expect_vector(Lexer& lexer, const Location& where, const char* directive) {
  Vec3 v;
  for (double& x : v) x = expect_number(lexer, where, directive);
  return v;
}

// Sixteen numbers, column after column.
Transform expect_matrix(Lexer& lexer, const Location& where, const char* directive) {
  const auto open = lexer.peek();
  const bool bracket = open && open->kind == Token::Kind::kOpen;
  if (bracket) lexer.next();
  double m[16];
  for (double& x : m) x = expect_number(lexer, where, directive);
  if (bracket) {
    const auto close = lexer.next();
    if (!close || close->kind != Token::Kind::kClose) throw Error(where, std::string(directive) + ": expected ']'");
  }
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] == 0) {
    throw Error(where, std::string(directive) + ": only affine transforms are known; the last row must be 0 0 0 1");
  }
  Transform result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) result.m[row][column] = m[4 * column + row] / m[15];
  }
  return result;
}

}  // namespace

void Directives::set_transform(const Transform& transform, const Location& where) {
  if (!transform.is_finite()) throw Error(where, "the transform is not finite");
  state_.transform = transform;
}

void Directives::identity(Lexer&, const Location&) { state_.transform = Transform{}; }

void Directives::translate(Lexer& lexer, const Location& where) {
  const Vec3 t = expect_vector(lexer, where, "Translate");
  set_transform(state_.transform * translation(t[0], t[1], t[2]), where);
}

void Directives::scale(Lexer& lexer, const Location& where) {
  const Vec3 s = expect_vector(lexer, where, "Scale");
  if (s[0] == 0 || s[1] == 0 || s[2] == 0) throw Error(where, "Scale: a factor of zero cannot be undone; use another");
  set_transform(state_.transform * scaling(s[0], s[1], s[2]), where);
}

void Directives::rotate(Lexer& lexer, const Location& where) {
  const double degrees = expect_number(lexer, where, "Rotate");
  const Vec3 axis = expect_vector(lexer, where, "Rotate");
  if (length(axis) == 0) throw Error(where, "Rotate: the axis has no length");
  set_transform(state_.transform * rotation(degrees, axis), where);
}

void Directives::look_at_directive(Lexer& lexer, const Location& where) {
  const Vec3 eye = expect_vector(lexer, where, "LookAt");
  const Vec3 target = expect_vector(lexer, where, "LookAt");
  const Vec3 up = expect_vector(lexer, where, "LookAt");
  const Vec3 axis = {target[0] - eye[0], target[1] - eye[1], target[2] - eye[2]};
  if (length(axis) == 0) throw Error(where, "LookAt: eye and target are the same point");
  if (length(up) == 0 || length(cross(normalized(up), normalized(axis))) < 1e-9) {
    throw Error(where, "LookAt: up has no length or is parallel to the direction of view; choose another");
  }
  set_transform(state_.transform * look_at(eye, target, up), where);
}

void Directives::transform(Lexer& lexer, const Location& where) {
  set_transform(expect_matrix(lexer, where, "Transform"), where);
}

void Directives::concat_transform(Lexer& lexer, const Location& where) {
  set_transform(state_.transform * expect_matrix(lexer, where, "ConcatTransform"), where);
}

void Directives::coordinate_system(Lexer& lexer, const Location& where) {
  coordinate_systems_[expect_string(lexer, where, "CoordinateSystem: a name")] = state_.transform;
}

void Directives::coord_sys_transform(Lexer& lexer, const Location& where) {
  const std::string name = expect_string(lexer, where, "CoordSysTransform: a name");
  const auto found = coordinate_systems_.find(name);
  if (found == coordinate_systems_.end()) {
    throw Error(where, "there is no coordinate system '" + name + "'; define it with CoordinateSystem");
  }
  state_.transform = found->second;
}

void Directives::active_transform(Lexer& lexer, const Location& where) {
  const auto token = lexer.next();
  if (!token || token->text != "All") throw Error(where, "moving objects are not known; remove ActiveTransform");
}

void Directives::transform_times(Lexer& lexer, const Location& where) {
  expect_number(lexer, where, "TransformTimes");
  expect_number(lexer, where, "TransformTimes");
}

}  // namespace bdpt_tool
