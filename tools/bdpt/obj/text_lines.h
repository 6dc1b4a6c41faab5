// The lines of OBJ and MTL files.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "error.h"

namespace bdpt_tool::obj {

// As UTF-8 without byte order mark; UTF-16 is known by its mark. Throws an Error for text that holds zero bytes.
std::string decoded(std::string_view data, const std::string& path);

struct Line {
  std::string_view keyword;
  std::string_view rest;  // without spaces around it
  Location where;

  std::vector<std::string_view> words() const;
};

class LineReader {
 public:
  // The text must outlive the reader and its lines.
  LineReader(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  // The next line that says something, without comments; those that end in a backslash go on with the next.
  std::optional<Line> next();

 private:
  std::string_view text_;
  std::string path_;
  std::size_t at_ = 0;
  int line_ = 0;
  std::string joined_;
};

// Numbers of a line; throws an Error for what is no finite number, and if there are fewer than `least`.
std::vector<float> numbers(const Line& line, std::size_t least);
float number(std::string_view word, const Location& where);

}  // namespace bdpt_tool::obj
