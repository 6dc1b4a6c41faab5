// SPDX-License-Identifier: Apache-2.0
#include "obj/text_lines.h"

#include <charconv>
#include <cmath>
#include <cstdint>

namespace bdpt_tool::obj {
namespace {

constexpr std::string_view kSpaces = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kSpaces);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpaces) + 1 - begin);
}

void append_utf8(std::string& text, std::uint32_t code) {
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return put(code);
  if (code < 0x800) {
    put(0xC0 | code >> 6);
  } else if (code < 0x10000) {
    put(0xE0 | code >> 12);
    put(0x80 | (code >> 6 & 63));
  } else {
    put(0xF0 | code >> 18);
    put(0x80 | (code >> 12 & 63));
    put(0x80 | (code >> 6 & 63));
  }
  put(0x80 | (code & 63));
}

// Halves of pairs that stand alone become U+FFFD.
std::string from_utf16(std::string_view data, bool big_endian) {
  const auto unit = [&](std::size_t i) -> std::uint32_t {
    const auto a = static_cast<unsigned char>(data[i]), b = static_cast<unsigned char>(data[i + 1]);
    return big_endian ? std::uint32_t{a} << 8 | b : std::uint32_t{b} << 8 | a;
  };
  std::string text;
  text.reserve(data.size() / 2);
  for (std::size_t i = 2; i + 1 < data.size(); i += 2) {
    std::uint32_t code = unit(i);
    const std::uint32_t low = i + 3 < data.size() ? unit(i + 2) : 0;
    if (code >= 0xD800 && code < 0xDC00 && low >= 0xDC00 && low < 0xE000) {
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
      i += 2;
    } else if (code >= 0xD800 && code < 0xE000) {
      code = 0xFFFD;
    }
    append_utf8(text, code);
  }
  return text;
}

}  // namespace

std::string decoded(std::string_view data, const std::string& path) {
  std::string text;
  if (data.starts_with("\xFE\xFF") || data.starts_with("\xFF\xFE")) {
    text = from_utf16(data, data[0] == '\xFE');
  } else {
    text = data.substr(data.starts_with("\xEF\xBB\xBF") ? 3 : 0);
  }
  if (text.find('\0') != std::string::npos) {
    throw Error(Location{path, 0}, "this is no text; it is damaged, or of another format than its name says");
  }
  return text;
}

std::vector<std::string_view> Line::words() const {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; (at = rest.find_first_not_of(kSpaces, at)) != std::string_view::npos;) {
    const std::size_t end = std::min(rest.find_first_of(kSpaces, at), rest.size());
    words.push_back(rest.substr(at, end - at));
    at = end;
  }
  return words;
}

std::optional<Line> LineReader::next() {
  while (at_ < text_.size()) {
    const int first = line_ + 1;
    joined_.clear();
    std::string_view whole;
    for (bool goes_on = true; goes_on && at_ < text_.size();) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      std::string_view part = text_.substr(at_, end - at_);
      at_ = end + 1;
      ++line_;
      if (part.ends_with('\r')) part.remove_suffix(1);
      goes_on = part.ends_with('\\');
      if (goes_on) part.remove_suffix(1);
      if (!goes_on && joined_.empty()) {
        whole = part;
      } else {
        joined_.append(part).append(" ");
        whole = joined_;
      }
    }
    const std::string_view text = trimmed(whole.substr(0, whole.find('#')));
    if (text.empty()) continue;
    const std::size_t end = std::min(text.find_first_of(kSpaces), text.size());
    return Line{text.substr(0, end), trimmed(text.substr(end)), {path_, first}};
  }
  return std::nullopt;
}

float number(std::string_view word, const Location& where) {
  const char* begin = word.data();
  const char* end = begin + word.size();
  if (word.size() > 1 && *begin == '+' && begin[1] != '-') ++begin;
  float value = 0;
  const auto result = std::from_chars(begin, end, value);
  if (result.ec == std::errc::result_out_of_range && result.ptr == end) {
    double wide = 0;  // too small for a float is zero
    std::from_chars(begin, end, wide);
    if (std::abs(wide) < 1) return 0;
  }
  if (result.ec != std::errc() || result.ptr != end) {
    throw Error(where, "expected a number, found '" + std::string(word.substr(0, 40)) + "'");
  }
  if (!std::isfinite(value)) throw Error(where, "'" + std::string(word) + "' is not finite");
  return value;
}

std::vector<float> numbers(const Line& line, std::size_t least) {
  std::vector<float> values;
  for (const std::string_view word : line.words()) values.push_back(number(word, line.where));
  if (values.size() < least) {
    throw Error(line.where, "'" + std::string(line.keyword) + "' needs " + std::to_string(least) + " numbers");
  }
  return values;
}

}  // namespace bdpt_tool::obj
