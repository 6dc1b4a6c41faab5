// SPDX-License-Identifier: Apache-2.0
#include "technique_mask.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "error.h"

namespace bdpt_tool {

const char kTechniqueMaskHelp[] =
    "MASK is a union of terms, separated by commas; a term is an intersection of factors, separated by '&'; a factor "
    "is "
    "a comparison of s or t with a number from 0 to 31 (s<=1, t>2, s=0), one technique SxT (2x2), or all. 31 stands "
    "for 31 "
    "and more. s counts the vertices of the light subpath, t those of the eye subpath. 's<=1&t>=2' is path tracing, "
    "'t<=1' light tracing, '0x2,1x2' direct light alone. The weights know only the techniques allowed.";

namespace {

constexpr std::uint32_t kLast = 31;

[[noreturn]] void fail(std::string_view factor) {
  throw Error(ExitCode::kUsage, "--techniques: '" + std::string(factor) +
                                    "' is not understood; use terms such as s<=1, t>=2, 2x2, joined by ',' and '&'");
}

std::optional<std::uint32_t> parse_number(std::string_view text) {
  std::uint32_t value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end || value > kLast) return std::nullopt;
  return value;
}

bool compare(std::uint32_t value, std::string_view operation, std::uint32_t limit) {
  if (operation == "<=") return value <= limit;
  if (operation == ">=") return value >= limit;
  if (operation == "<") return value < limit;
  if (operation == ">") return value > limit;
  return value == limit;
}

template <class Predicate>
TechniqueMask mask_where(Predicate predicate) {
  TechniqueMask mask{};
  for (std::uint32_t s = 0; s <= kLast; ++s) {
    for (std::uint32_t t = 0; t <= kLast; ++t) {
      if (predicate(s, t)) mask[s] |= std::uint32_t{1} << t;
    }
  }
  return mask;
}

TechniqueMask parse_comparison(std::string_view factor) {
  const std::size_t length = factor.find_first_not_of("<>=", 1) - 1;
  const std::string_view operation = factor.substr(1, length);
  const bool known = operation == "<=" || operation == ">=" || operation == "<" || operation == ">" ||
                     operation == "=" || operation == "==";
  if (!known || length >= factor.size()) fail(factor);
  const auto limit = parse_number(factor.substr(1 + length));
  if (!limit) fail(factor);
  const bool of_s = factor[0] == 's';
  return mask_where([&](std::uint32_t s, std::uint32_t t) { return compare(of_s ? s : t, operation, *limit); });
}

TechniqueMask parse_factor(std::string_view factor) {
  if (factor == "all") return mask_where([](std::uint32_t, std::uint32_t) { return true; });
  if (factor.size() >= 3 && (factor[0] == 's' || factor[0] == 't')) return parse_comparison(factor);
  const std::size_t x = factor.find('x');
  if (x == std::string_view::npos) fail(factor);
  const auto s = parse_number(factor.substr(0, x)), t = parse_number(factor.substr(x + 1));
  if (!s || !t) fail(factor);
  return mask_where([&](std::uint32_t a, std::uint32_t b) { return a == *s && b == *t; });
}

// Calls `use` for each part of the text between separators.
template <class Use>
void split(std::string_view text, char separator, Use use) {
  while (true) {
    const std::size_t end = text.find(separator);
    use(text.substr(0, end));
    if (end == std::string_view::npos) return;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

TechniqueMask parse_technique_mask(std::string_view text) {
  std::string compact(text);
  std::erase(compact, ' ');
  TechniqueMask mask{};
  split(compact, ',', [&](std::string_view term) {
    TechniqueMask product;
    product.fill(~std::uint32_t{0});
    split(term, '&', [&](std::string_view factor) {
      const TechniqueMask one = parse_factor(factor);
      for (std::size_t s = 0; s < mask.size(); ++s) product[s] &= one[s];
    });
    for (std::size_t s = 0; s < mask.size(); ++s) mask[s] |= product[s];
  });
  if (std::all_of(mask.begin(), mask.end(), [](std::uint32_t bits) { return bits == 0; })) {
    throw Error(ExitCode::kUsage, "--techniques: '" + std::string(text) + "' allows no technique");
  }
  return mask;
}

bool allows(const TechniqueMask& mask, std::uint32_t s, std::uint32_t t) {
  return (mask[std::min(s, kLast)] >> std::min(t, kLast)) & 1;
}

}  // namespace bdpt_tool
