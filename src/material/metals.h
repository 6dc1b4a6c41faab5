// Measured metals.
#pragma once

#include <string>

#include "math/vec.h"

namespace bdpt {

struct Metal {
  const char* name;
  Rgb eta, k;
};

// nullptr for a name that is none's.
const Metal* find_metal(const std::string& name);
// All names, with commas between them.
std::string metal_names();

}  // namespace bdpt
