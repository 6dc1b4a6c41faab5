// SPDX-License-Identifier: Apache-2.0
#include "pbrt/lexer.h"

#include <utility>

namespace bdpt_tool {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
bool ends_word(char c) { return is_space(c) || c == '"' || c == '[' || c == ']' || c == '#'; }

}  // namespace

std::string Token::string() const {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      result += text[i];
      continue;
    }
    const char c = text[++i];
    result += c == 'n' ? '\n' : c == 't' ? '\t' : c == 'r' ? '\r' : c;
  }
  return result;
}

Lexer::Lexer(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
}

void Lexer::skip_space() {
  while (at_ < text_.size()) {
    if (text_[at_] == '#') {
      while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    } else if (is_space(text_[at_])) {
      if (text_[at_++] == '\n') ++line_;
    } else {
      return;
    }
  }
}

Token Lexer::string_token() {
  const std::size_t begin = ++at_;
  for (; at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\n'; ++at_) {
    if (text_[at_] == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
  }
  if (at_ >= text_.size() || text_[at_] == '\n') {
    throw Error(location(line_), "this string does not end on its line; add the closing quote");
  }
  return {Token::Kind::kString, text_.substr(begin, at_++ - begin), line_};
}

std::optional<Token> Lexer::next() {
  if (peeked_) return std::exchange(peeked_, std::nullopt);
  skip_space();
  if (at_ >= text_.size()) return std::nullopt;
  const std::size_t begin = at_;
  switch (text_[at_]) {
    case '"':
      return string_token();
    case '[':
      ++at_;
      return Token{Token::Kind::kOpen, text_.substr(begin, 1), line_};
    case ']':
      ++at_;
      return Token{Token::Kind::kClose, text_.substr(begin, 1), line_};
    default:
      while (at_ < text_.size() && !ends_word(text_[at_])) ++at_;
      return Token{Token::Kind::kWord, text_.substr(begin, at_ - begin), line_};
  }
}

std::optional<Token> Lexer::peek() {
  if (!peeked_) peeked_ = next();
  return peeked_;
}

}  // namespace bdpt_tool
