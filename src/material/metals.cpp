#include "material/metals.h"

namespace bdpt {
namespace {

// By scripts/metals, from refractiveindex.info: Johnson and Christy (1972), and Rakic (1995).
const Metal kMetals[] = {
    {"Ag", {0.0556f, 0.0547f, 0.0429f}, {4.3536f, 3.5349f, 2.5668f}},
    {"Al", {1.4733f, 0.9856f, 0.5976f}, {7.6370f, 6.5560f, 5.3459f}},
    {"Au", {0.0630f, 0.4976f, 1.4595f}, {3.6011f, 2.3296f, 1.8177f}},
    {"Cu", {0.1785f, 1.0408f, 1.2904f}, {3.2701f, 2.6046f, 2.3662f}},
};

}  // namespace

const Metal* find_metal(const std::string& name) {
  for (const Metal& m : kMetals)
    if (name == m.name) return &m;
  return nullptr;
}

std::string metal_names() {
  std::string names;
  for (const Metal& m : kMetals) names += std::string(names.empty() ? "" : ", ") + m.name;
  return names;
}

}  // namespace bdpt
