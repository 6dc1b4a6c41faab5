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
    open_here('{');
  }
  void close() { close_here('}'); }

  // A list of objects or of other lists, each opened without a key, and of values.
  void open_list(std::string_view key) {
    begin(key);
    open_here('[');
  }
  void open_list() {
    separate();
    open_here('[');
  }
  void close_list() { close_here(']'); }
  void open() {
    separate();
    open_here('{');
  }
  void element(double value) {
    separate();
    number(value);
  }
  void element(std::string_view value) {
    separate();
    string(value);
  }

  // Closes the outermost object.
  std::string finish() && { return std::move(text_) + "}\n"; }

 private:
  void separate() {
    if (!first_) text_ += ", ";
    first_ = false;
  }
  void begin(std::string_view key) {
    separate();
    string(key);
    text_ += ": ";
  }
  void open_here(char bracket) {
    text_ += bracket;
    first_ = true;
  }
  void close_here(char bracket) {
    text_ += bracket;
    first_ = false;
  }

  // null when not finite; with as many digits as tell the value from its neighbours.
  void number(double value);
  void number(float value);
  void string(std::string_view value);

  std::string text_;
  bool first_ = true;
};

}  // namespace bdpt_tool
