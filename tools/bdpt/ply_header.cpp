// SPDX-License-Identifier: Apache-2.0
#include "ply_header.h"

#include <array>
#include <charconv>
#include <optional>
#include <utility>

namespace bdpt_tool {
namespace {

std::optional<PlyType> parse_type(std::string_view word) {
  static constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes = {{
      {"char", PlyType::kInt8},
      {"int8", PlyType::kInt8},
      {"uchar", PlyType::kUint8},
      {"uint8", PlyType::kUint8},
      {"short", PlyType::kInt16},
      {"int16", PlyType::kInt16},
      {"ushort", PlyType::kUint16},
      {"uint16", PlyType::kUint16},
      {"int", PlyType::kInt32},
      {"int32", PlyType::kInt32},
      {"uint", PlyType::kUint32},
      {"uint32", PlyType::kUint32},
      {"float", PlyType::kFloat32},
      {"float32", PlyType::kFloat32},
      {"double", PlyType::kFloat64},
      {"float64", PlyType::kFloat64},
  }};
  for (const auto& [name, type] : kTypes) {
    if (name == word) return type;
  }
  return std::nullopt;
}

std::vector<std::string_view> split_words(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos) {
    std::size_t end = line.find_first_of(" \t\r", at);
    if (end == std::string_view::npos) end = line.size();
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

class HeaderParser {
 public:
  HeaderParser(std::string_view text, const std::string& path) : text_(text), where_{path, 0} {}

  PlyHeader parse() {
    if (next_line() != std::vector<std::string_view>{"ply"}) fail("not a PLY file; it must begin with a line 'ply'");
    while (true) {
      const auto words = next_line();
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      statement(words);
    }
    if (!has_format_) fail("the header has no 'format' line; the file is damaged");
    header_.size = at_;
    header_.lines = where_.line;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& text) const { throw Error(where_, text); }

  std::vector<std::string_view> next_line() {
    ++where_.line;
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string_view::npos) fail("the header does not end; the file is cut off or no PLY file");
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = end + 1;
    return split_words(line);
  }

  void statement(const std::vector<std::string_view>& words) {
    if (words[0] == "format") {
      format(words);
    } else if (words[0] == "element") {
      element(words);
    } else if (words[0] == "property") {
      property(words);
    } else {
      fail("unknown statement '" + std::string(words[0]) + "' in the header");
    }
  }

  void format(const std::vector<std::string_view>& words) {
    if (words.size() != 3 || words[2] != "1.0") fail("expected 'format <encoding> 1.0'");
    if (words[1] == "ascii") {
      header_.encoding = PlyEncoding::kAscii;
    } else if (words[1] == "binary_little_endian") {
      header_.encoding = PlyEncoding::kLittleEndian;
    } else if (words[1] == "binary_big_endian") {
      header_.encoding = PlyEncoding::kBigEndian;
    } else {
      fail("unknown encoding '" + std::string(words[1]) + "'");
    }
    has_format_ = true;
  }

  void element(const std::vector<std::string_view>& words) {
    if (words.size() != 3) fail("expected 'element <name> <count>'");
    PlyElement element;
    element.name = words[1];
    const char* end = words[2].data() + words[2].size();
    const auto result = std::from_chars(words[2].data(), end, element.count);
    if (result.ec != std::errc() || result.ptr != end) fail("'" + std::string(words[2]) + "' is no count");
    header_.elements.push_back(std::move(element));
  }

  PlyType type(std::string_view word) const {
    const auto type = parse_type(word);
    if (!type) fail("unknown type '" + std::string(word) + "'");
    return *type;
  }

  void property(const std::vector<std::string_view>& words) {
    if (header_.elements.empty()) fail("a property before the first element");
    PlyProperty property;
    if (words.size() == 3) {
      property = {std::string(words[2]), type(words[1]), false, PlyType::kUint8};
    } else if (words.size() == 5 && words[1] == "list") {
      property = {std::string(words[4]), type(words[3]), true, type(words[2])};
      if (property.count_type >= PlyType::kFloat32) fail("the length of a list cannot be a float");
    } else {
      fail("expected 'property <type> <name>' or 'property list <type> <type> <name>'");
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  std::string_view text_;
  Location where_;
  std::size_t at_ = 0;
  bool has_format_ = false;
  PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kFloat64:
      return 8;
    default:
      return 4;
  }
}

std::size_t PlyElement::least_record_size() const {
  std::size_t size = 0;
  for (const PlyProperty& property : properties)
    size += size_of(property.is_list ? property.count_type : property.type);
  return size;
}

bool PlyElement::has_list() const {
  for (const PlyProperty& property : properties) {
    if (property.is_list) return true;
  }
  return false;
}

PlyHeader parse_ply_header(std::string_view text, const std::string& path) { return HeaderParser(text, path).parse(); }

}  // namespace bdpt_tool
