// SPDX-License-Identifier: Apache-2.0
#include "point_list.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace bdpt_tool {
namespace {

constexpr std::string_view kSeparators = ", ;\t\r";

bool is_names(std::string_view line) {
  const std::size_t first = line.find_first_not_of(kSeparators);
  const char c = line[first];
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '"';
}

bdpt_point to_point(const std::vector<double>& numbers) {
  auto point = bdpt_point{};
  for (std::size_t i = 0; i < 3; ++i) {
    point.position[i] = static_cast<float>(numbers[i]);
    if (numbers.size() == 6) point.normal[i] = static_cast<float>(numbers[3 + i]);
  }
  return point;
}

}  // namespace

std::vector<double> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; (at = text.find_first_not_of(kSeparators, at)) != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kSeparators, at), text.size());
    const std::string_view word = text.substr(at, end - at);
    const char* const begin = word.data() + (word[0] == '+' ? 1 : 0);
    double value = 0;
    const auto [rest, error] = std::from_chars(begin, word.data() + word.size(), value);
    if (error != std::errc() || rest != word.data() + word.size() || !std::isfinite(static_cast<float>(value)))
      throw std::invalid_argument("'" + std::string(word) + "' is no number that can be used");
    numbers.push_back(value);
    at = end;
  }
  return numbers;
}

std::vector<bdpt_point> read_points(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw Error(Location{path, 0}, "cannot be read; give a text file with a point x y z in each line");
  std::vector<bdpt_point> points;
  Location where{path, 0};
  bool names_may_come = true;
  for (std::string line; std::getline(file, line);) {
    ++where.line;
    line.erase(std::min(line.find('#'), line.size()));
    if (line.find_first_not_of(kSeparators) == std::string::npos) continue;
    if (std::exchange(names_may_come, false) && is_names(line)) continue;
    std::vector<double> numbers;
    try {
      numbers = parse_numbers(line);
    } catch (const std::invalid_argument& error) {
      throw Error(where, error.what());
    }
    if (numbers.size() != 3 && numbers.size() != 6)
      throw Error(where, std::to_string(numbers.size()) + " numbers; write x y z, or x y z nx ny nz");
    if (numbers.size() == 6 && numbers[3] == 0 && numbers[4] == 0 && numbers[5] == 0)
      throw Error(where, "a normal of length zero; leave it out in all lines for light from everywhere");
    points.push_back(to_point(numbers));
    if (has_normal(points.back()) != has_normal(points.front()))
      throw Error(where, "points with a normal and points without; put them in two files");
  }
  if (points.empty()) throw Error(Location{path, 0}, "has no points; write one in each line, x y z or x y z nx ny nz");
  return points;
}

std::vector<bdpt_point> grid_points(const std::array<std::uint32_t, 3>& cells, const std::array<double, 6>& box) {
  std::vector<bdpt_point> points;
  const auto at = [&](std::size_t axis, std::uint32_t i) {
    return static_cast<float>(box[axis] + (box[3 + axis] - box[axis]) * (i + 0.5) / cells[axis]);
  };
  for (std::uint32_t z = 0; z < cells[2]; ++z)
    for (std::uint32_t y = 0; y < cells[1]; ++y)
      for (std::uint32_t x = 0; x < cells[0]; ++x) {
        points.push_back({});
        points.back().position[0] = at(0, x), points.back().position[1] = at(1, y),
        points.back().position[2] = at(2, z);
      }
  return points;
}

bool has_normal(const bdpt_point& point) {
  return point.normal[0] != 0 || point.normal[1] != 0 || point.normal[2] != 0;
}

}  // namespace bdpt_tool
