// Cuts the text of a pbrt scene file into tokens.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "error.h"

namespace bdpt_tool {

struct Token {
  enum class Kind { kWord, kString, kOpen, kClose };  // kOpen and kClose are the brackets
  Kind kind = Kind::kWord;
  std::string_view text;  // without the quotes, escapes not yet resolved
  int line = 0;

  // The text with escapes such as \" resolved.
  std::string string() const;
};

class Lexer {
 public:
  // The text must outlive the lexer and its tokens.
  Lexer(std::string_view text, std::string file);

  // The next token; nothing at the end of the file.
  std::optional<Token> next();
  std::optional<Token> peek();

  Location location(int line) const { return {file_, line}; }
  const std::string& file() const { return file_; }

 private:
  void skip_space();
  Token string_token();

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::optional<Token> peeked_;
};

}  // namespace bdpt_tool
