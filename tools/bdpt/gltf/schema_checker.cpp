// SPDX-License-Identifier: Apache-2.0
#include "gltf/schema_checker.h"

#include <cstdio>

#include "error.h"

namespace bdpt_tool::gltf {
namespace {

constexpr double kNoLimit = 1e9;  // what an upper limit above it says is of no help

std::string short_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

std::string range_of(const Rule& rule) {
  if (rule.low == -FLT_MAX) return "a number that a 32-bit float can hold";
  if (rule.high >= kNoLimit) return short_number(rule.low) + " or more";
  return "from " + short_number(rule.low) + " to " + short_number(rule.high);
}

}  // namespace

const Json* member(const Json* value, std::string_view name) {
  if (!value || !value->is_object()) return nullptr;
  const auto found = value->find(name);
  return found == value->end() ? nullptr : &*found;
}

std::string with_count(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void Checker::fail(const std::string& property, const std::string& text) const {
  throw Error(Location{path_, 0}, property + " " + text);
}

void Checker::visit(const Json& value, const Rule& rule, std::string_view rest, const std::string& at) const {
  require_kind(value.is_object(), at, "an object, in braces");
  const std::size_t dot = rest.find('.');
  std::string_view name = rest.substr(0, dot);
  const bool last = dot == std::string_view::npos;
  const bool each = name.ends_with("[]");
  if (each) name.remove_suffix(2);
  if (name == "*") {
    for (const auto& [key, element] : value.items()) require(element, rule, at + "." + key);
    return;
  }
  const Json* found = member(&value, name);
  if (!found && !(last && rule.required)) return;
  const std::string property = at.empty() ? std::string(name) : at + "." + std::string(name);
  if (!found) fail(property, "is missing");
  if (last) {
    require(*found, rule, property);
  } else if (each) {
    require_each(*found, property, [&](const Json& element, const std::string& place) {
      visit(element, rule, rest.substr(dot + 1), place);
    });
  } else {
    visit(*found, rule, rest.substr(dot + 1), property);
  }
}

void Checker::require(const Json& value, const Rule& rule, const std::string& at) const {
  switch (rule.kind) {
    case Kind::kObject:
      return require_kind(value.is_object(), at, "an object, in braces");
    case Kind::kArray:
      return require_kind(value.is_array(), at, "an array, in brackets");
    case Kind::kText:
      return require_kind(value.is_string(), at, "a string, in quotes");
    case Kind::kTexts:
      return require_each(value, at, [&](const Json& element, const std::string& place) {
        require_kind(element.is_string(), place, "a string, in quotes");
      });
    case Kind::kBoolean:
      return require_kind(value.is_boolean(), at, "true or false");
    case Kind::kInteger:
      require_kind(value.is_number_integer(), at, "a whole number");
      return require_number(value, rule, at);
    case Kind::kNumber:
      return require_number(value, rule, at);
    case Kind::kNumbers:
      if (rule.count > 0 && (!value.is_array() || value.size() != rule.count)) {
        fail(at, "must be an array of " + with_count(rule.count, "number"));
      }
      return require_each(value, at,
                          [&](const Json& element, const std::string& place) { require_number(element, rule, place); });
    case Kind::kIndex:
      return require_index(value, rule, at);
    case Kind::kIndices:
      return require_each(value, at,
                          [&](const Json& element, const std::string& place) { require_index(element, rule, place); });
  }
}

void Checker::require_kind(bool is_so, const std::string& at, const char* what) const {
  if (!is_so) fail(at, std::string("must be ") + what);
}

void Checker::require_each(const Json& value, const std::string& at, const Require& require_element) const {
  require_kind(value.is_array(), at, "an array, in brackets");
  std::size_t i = 0;
  for (const Json& element : value) require_element(element, at + "[" + std::to_string(i++) + "]");
}

void Checker::require_number(const Json& value, const Rule& rule, const std::string& at) const {
  require_kind(value.is_number(), at, "a number");
  const auto x = value.get<double>();
  if (!(x >= rule.low && x <= rule.high)) fail(at, "is " + value.dump() + ", and must be " + range_of(rule));
}

void Checker::require_index(const Json& value, const Rule& rule, const std::string& at) const {
  require_kind(value.is_number_integer(), at, "an index, a whole number");
  const Json* pointed = &document_;
  for (std::string_view rest = rule.of; !rest.empty();) {
    const std::size_t dot = rest.find('.');
    pointed = member(pointed, rest.substr(0, dot));
    rest = dot == std::string_view::npos ? std::string_view() : rest.substr(dot + 1);
  }
  const std::size_t count = pointed && pointed->is_array() ? pointed->size() : 0;
  if (!value.is_number_unsigned() || value.get<std::size_t>() >= count) {
    fail(at, "is " + value.dump() + ", and " + rule.of + " has " + with_count(count, "element"));
  }
}

}  // namespace bdpt_tool::gltf
