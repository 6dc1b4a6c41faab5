// What someone may have meant who wrote a name that does not exist.
#pragma once

#include <string>
#include <vector>

namespace bdpt {

// "did you mean 'A' or 'B'? there are 'A', 'B', ...": those that differ from name by few letters, perhaps none, and
// then the first of all.
std::string suggestions(const std::string& name, const std::vector<std::string>& known);

}  // namespace bdpt
