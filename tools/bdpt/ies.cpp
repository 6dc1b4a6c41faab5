// SPDX-License-Identifier: Apache-2.0
#include "ies.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "error.h"
#include "file_data.h"

namespace bdpt_tool {

namespace {

constexpr int kMostAngles = 4096;

class Reader {
 public:
  Reader(std::string_view text, const std::string& name) : left_(text), name_(name) {}

  [[noreturn]] void refuse(const std::string& text) const { throw Error(Location{name_, line_}, text); }

  std::string_view line() {
    if (left_.empty()) refuse("ends before the photometry: there is no line TILT=");
    ++line_;
    const std::size_t end = std::min(left_.find('\n'), left_.size());
    std::string_view line = left_.substr(0, end);
    left_.remove_prefix(std::min(end + 1, left_.size()));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    return line;
  }
  // From the line after the one just read.
  void begin_numbers() { ++line_; }
  double number(const char* what) {
    skip_blanks();
    if (left_.empty()) refuse(std::string("ends where ") + what + " should be");
    if (left_.front() == '+') left_.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(left_.data(), left_.data() + left_.size(), value);
    if (error != std::errc() || !std::isfinite(value))
      refuse(std::string("no number where ") + what + " should be: " + std::string(left_.substr(0, 16)));
    left_.remove_prefix(static_cast<std::size_t>(end - left_.data()));
    return value;
  }
  int whole(const char* what, int least, int most) {
    const double value = number(what);
    if (value < least || value > most || value != std::floor(value))
      refuse(std::string(what) + " is " + std::to_string(value) + ": it must be a whole number from " +
             std::to_string(least) + " to " + std::to_string(most));
    return static_cast<int>(value);
  }
  std::vector<float> numbers(const char* what, int count) {
    std::vector<float> values;
    for (int i = 0; i < count; ++i) values.push_back(static_cast<float>(number(what)));
    return values;
  }
  std::vector<float> angles(const char* what, int count, float least, float most) {
    const std::vector<float> values = numbers(what, count);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!(values[i] >= least && values[i] <= most) || (i > 0 && !(values[i] > values[i - 1])))
        refuse(std::string(what) + " go through " + std::to_string(values[i]) + ": they must ascend from " +
               std::to_string(static_cast<int>(least)) + " to " + std::to_string(static_cast<int>(most)));
    return values;
  }

 private:
  void skip_blanks() {
    constexpr std::string_view kBlanks = " \t\r\n,";
    while (!left_.empty() && kBlanks.find(left_.front()) != kBlanks.npos) {
      line_ += left_.front() == '\n';
      left_.remove_prefix(1);
    }
  }

  std::string_view left_;
  std::string name_;
  int line_ = 0;
};

// Up to the numbers; how the lamp's output goes with the luminaire's tilt does not concern its distribution.
void skip_head(Reader& reader) {
  for (;;) {
    const std::string_view line = reader.line();
    if (line.substr(0, 5) != "TILT=") continue;
    const std::string_view tilt = line.substr(5);
    if (tilt != "NONE" && tilt != "INCLUDE")
      reader.refuse("TILT=" + std::string(tilt) + " names another file: only NONE and INCLUDE are read");
    reader.begin_numbers();
    if (tilt == "NONE") return;
    reader.whole("the lamp's place", 1, 3);
    const int pairs = reader.whole("the number of tilts", 1, kMostAngles);
    reader.numbers("an angle of tilt", pairs);
    reader.numbers("a factor of tilt", pairs);
    return;
  }
}

// Measured from 90 to 270 and mirrored at that plane: from 0 to 360.
void unfold_from_90(Luminaire& l) {
  const std::size_t rows = l.vertical_angles.size(), n = l.horizontal_angles.size();
  Luminaire all{l.vertical_angles, {}, {}};
  const auto add = [&](float angle, std::size_t i) {
    if (!all.horizontal_angles.empty() && !(angle > all.horizontal_angles.back())) return;
    all.horizontal_angles.push_back(angle);
    const auto first = l.candela.begin() + static_cast<std::ptrdiff_t>(i * rows);
    all.candela.insert(all.candela.end(), first, first + static_cast<std::ptrdiff_t>(rows));
  };
  for (std::size_t i = n; i-- > 0;)
    if (l.horizontal_angles[i] <= 180) add(180 - l.horizontal_angles[i], i);
  for (std::size_t i = 0; i < n; ++i) add(l.horizontal_angles[i], i);
  for (std::size_t i = n; i-- > 0;)
    if (l.horizontal_angles[i] >= 180) add(540 - l.horizontal_angles[i], i);
  l = std::move(all);
}

void complete(Reader& reader, Luminaire& l) {
  std::vector<float>& angles = l.horizontal_angles;
  if (angles.front() == 90 && angles.back() == 270) {
    if (std::find(angles.begin(), angles.end(), 180.0f) == angles.end())
      reader.refuse("horizontal angles from 90 to 270 must hold 180");
    return unfold_from_90(l);
  }
  const float last = angles.back();
  if (angles.front() != 0 || (angles.size() == 1) != (last == 0) || (last < 180 && last != 90 && last != 0))
    reader.refuse("horizontal angles go from " + std::to_string(angles.front()) + " to " + std::to_string(last) +
                  ": photometry of type C has 0 alone, or goes from 0 to 90, 180 or 360, or from 90 to 270");
  if (last > 180 && last < 360) {  // all round, without the first again
    angles.push_back(360);
    const auto first = l.candela.begin();
    const std::vector<float> row(first, first + static_cast<std::ptrdiff_t>(l.vertical_angles.size()));
    l.candela.insert(l.candela.end(), row.begin(), row.end());
  }
}

}  // namespace

Luminaire parse_ies(const std::string& text, const std::string& name) {
  Reader reader(text, name);
  skip_head(reader);
  reader.number("the number of lamps");
  reader.number("the lumens of a lamp");
  const double multiplier = reader.number("the candela multiplier");
  const int rows = reader.whole("the number of vertical angles", 2, kMostAngles);
  const int columns = reader.whole("the number of horizontal angles", 1, kMostAngles);
  const int type = reader.whole("the photometric type", 1, 3);
  if (type != 1) reader.refuse(std::string("photometry of type ") + (type == 2 ? "B" : "A") + ": only type C is read");
  reader.whole("the unit of length", 1, 2);
  reader.numbers("the luminous opening", 3);
  const double ballast = reader.number("the ballast factor");
  reader.numbers("a field for future use and the watts", 2);
  Luminaire l;
  l.vertical_angles = reader.angles("vertical angles", rows, 0, 180);
  l.horizontal_angles = reader.angles("horizontal angles", columns, 0, 360);
  l.candela = reader.numbers("candela", rows * columns);
  for (float& v : l.candela) {
    v = static_cast<float>(v * multiplier * ballast);
    if (!(v >= 0) || !std::isfinite(v))
      reader.refuse("holds " + std::to_string(v) + " candela: they must be 0 or more");
  }
  complete(reader, l);
  return l;
}

Luminaire read_ies(const std::string& path) {
  const FileData data(path);
  return parse_ies(std::string(data.text()), path);
}

}  // namespace bdpt_tool
