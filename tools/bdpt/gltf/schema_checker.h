// Holds a JSON document against rules.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "gltf/schema_rules.h"

namespace bdpt_tool::gltf {

using Json = nlohmann::json;

// The member of an object, or nothing; `value` may be nothing, and no object.
const Json* member(const Json* value, std::string_view name);

// "1 byte", "2 bytes".
std::string with_count(std::size_t count, const std::string& noun);

class Checker {
 public:
  Checker(const std::string& path, const Json& document) : path_(path), document_(document) {}

  // Throws an Error that names the property which breaks the rule.
  void check(const Rule& rule) const { visit(document_, rule, rule.path, ""); }

  [[noreturn]] void fail(const std::string& property, const std::string& text) const;

 private:
  using Require = std::function<void(const Json&, const std::string& at)>;

  // `rest` is what of the rule's path lies below `value`, which the document has under the name `at`.
  void visit(const Json& value, const Rule& rule, std::string_view rest, const std::string& at) const;
  void require(const Json& value, const Rule& rule, const std::string& at) const;
  void require_kind(bool is_so, const std::string& at, const char* what) const;
  void require_each(const Json& value, const std::string& at, const Require& require_element) const;
  void require_number(const Json& value, const Rule& rule, const std::string& at) const;
  void require_index(const Json& value, const Rule& rule, const std::string& at) const;

  const std::string& path_;
  const Json& document_;
};

}  // namespace bdpt_tool::gltf
