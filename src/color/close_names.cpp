#include "color/close_names.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <optional>
#include <sstream>
#include <utility>

namespace bdpt {
namespace {

constexpr size_t kMostListed = 24, kMostSuggested = 3;

// Letters and digits alone, small: what is left of a name when punctuation is forgotten.
std::string plain(const std::string& name) {
  std::string letters;
  for (const unsigned char c : name)
    if (std::isalnum(c)) letters += static_cast<char>(std::tolower(c));
  return letters;
}

// Levenshtein's distance.
size_t distance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = std::exchange(row[0], i + 1);
    for (size_t j = 0; j < b.size(); ++j)
      diagonal = std::exchange(row[j + 1], std::min({row[j] + 1, row[j + 1] + 1, diagonal + (a[i] != b[j])}));
  }
  return row[b.size()];
}

// How little two names are alike; none where more than a third of the letters differ. A name that is a part of the
// other is closer than any misspelling, and the closer the less there is besides it.
using Rank = std::pair<size_t, size_t>;
std::optional<Rank> rank(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return {};
  const size_t longer = std::max(a.size(), b.size()), shorter = std::min(a.size(), b.size());
  if (shorter >= 3 && (a.find(b) != a.npos || b.find(a) != b.npos)) return Rank{0, longer - shorter};
  const size_t letters = distance(a, b);
  return 3 * letters <= longer ? std::optional(Rank{letters, 0}) : std::nullopt;
}

void list(std::ostream& out, const std::vector<std::string>& names, size_t count, const char* last) {
  for (size_t i = 0; i < count; ++i) out << (i == 0 ? "'" : i + 1 == count ? last : ", '") << names[i] << "'";
}

}  // namespace

std::string suggestions(const std::string& name, const std::vector<std::string>& known) {
  std::vector<std::pair<Rank, std::string>> ranked;
  for (const std::string& other : known)
    if (const auto found = rank(plain(name), plain(other))) ranked.emplace_back(*found, other);
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  ranked.resize(std::min(ranked.size(), kMostSuggested));

  std::vector<std::string> close;
  for (auto& [ignored, other] : ranked) close.push_back(std::move(other));
  std::ostringstream text;
  if (!close.empty()) {
    text << "did you mean ";
    list(text, close, close.size(), " or '");
    text << "? ";
  }
  text << (known.empty() ? "there is none" : "there are ");
  list(text, known, std::min(known.size(), kMostListed), ", '");
  if (known.size() > kMostListed) text << " and " << known.size() - kMostListed << " more";
  return text.str();
}

}  // namespace bdpt
