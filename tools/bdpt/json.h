// Writes JSON objects: just what the reports of this program need.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace bdpt_tool {

class JsonWriter {
 public:
  JsonWriter() { text_ = "{"; }

  template <class T>
  void value(std::string_view key, const T& value) {
    begin(key);
    if constexpr (std::is_same_v<T, bool>) {
      text_ += value ? "true" : "false";
    } else if constexpr (std::is_integral_v<T>) {
      text_ += std::to_string(value);
    } else if constexpr (std::is_floating_point_v<T>) {
      number(value);
    } else {
      string(value);
    }
  }

  // Three numbers, or as many as there are.
  template <class Range>
  void array(std::string_view key, const Range& values) {
    begin(key);
    text_ += '[';
    bool first = true;
    for (auto x : values) {
      if (!first) text_ += ", ";
      first = false;
      number(x);
    }
    text_ += ']';
  }

  void open(std::string_view key) {
    begin(key);
    text_ += '{';
    first_ = true;
  }
  void close() {
    text_ += '}';
    first_ = false;
  }

  // Closes the outermost object.
  std::string finish() && { return std::move(text_) + "}\n"; }

 private:
  void begin(std::string_view key) {
    if (!first_) text_ += ", ";
    first_ = false;
    string(key);
    text_ += ": ";
  }

  // null when not finite; with as many digits as tell the value from its neighbours.
  void number(double value);
  void number(float value);
  void string(std::string_view value);

  std::string text_;
  bool first_ = true;
};

}  // namespace bdpt_tool
