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

// Of the active ones.
template <class Change>
void Directives::change_transform(const Change& change, const Location& where) {
  MovingTransform& transform = state_.transform;
  if (state_.active[0]) transform.start = change(transform.start);
  if (state_.active[1]) transform.end = change(transform.end);
  if (!transform.start.is_finite() || !transform.end.is_finite()) throw Error(where, "the transform is not finite");
}

void Directives::identity(Lexer&, const Location& where) {
  change_transform([](const Transform&) { return Transform{}; }, where);
}

void Directives::translate(Lexer& lexer, const Location& where) {
  const Vec3 t = expect_vector(lexer, where, "Translate");
  change_transform([&](const Transform& before) { return before * translation(t[0], t[1], t[2]); }, where);
}

void Directives::scale(Lexer& lexer, const Location& where) {
  const Vec3 s = expect_vector(lexer, where, "Scale");
  if (s[0] == 0 || s[1] == 0 || s[2] == 0) throw Error(where, "Scale: a factor of zero cannot be undone; use another");
  change_transform([&](const Transform& before) { return before * scaling(s[0], s[1], s[2]); }, where);
}

void Directives::rotate(Lexer& lexer, const Location& where) {
  const double degrees = expect_number(lexer, where, "Rotate");
  const Vec3 axis = expect_vector(lexer, where, "Rotate");
  if (length(axis) == 0) throw Error(where, "Rotate: the axis has no length");
  change_transform([&](const Transform& before) { return before * rotation(degrees, axis); }, where);
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
  change_transform([&](const Transform& before) { return before * look_at(eye, target, up); }, where);
}

void Directives::transform(Lexer& lexer, const Location& where) {
  const Transform matrix = expect_matrix(lexer, where, "Transform");
  change_transform([&](const Transform&) { return matrix; }, where);
}

void Directives::concat_transform(Lexer& lexer, const Location& where) {
  const Transform matrix = expect_matrix(lexer, where, "ConcatTransform");
  change_transform([&](const Transform& before) { return before * matrix; }, where);
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
  const std::string_view which = token ? token->text : std::string_view();
  if (which != "All" && which != "StartTime" && which != "EndTime")
    throw Error(where, "ActiveTransform: give StartTime, EndTime or All");
  state_.active = {which != "EndTime", which != "StartTime"};
}

void Directives::transform_times(Lexer& lexer, const Location& where) {
  require_options(where, "TransformTimes");
  if (has_camera_) throw Error(where, "TransformTimes must come before Camera");
  for (double& time : transform_times_) time = expect_number(lexer, where, "TransformTimes");
  if (!(transform_times_[0] < transform_times_[1]))
    throw Error(where, "TransformTimes: the second must be the later one");
}

}  // namespace bdpt_tool
