// SPDX-License-Identifier: Apache-2.0
#include "gltf/accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace bdpt_tool::gltf {
namespace {

template <class T>
T load(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

template <class T>
float scaled(const unsigned char* bytes, bool normalized) {
  const auto value = static_cast<float>(load<T>(bytes));
  return normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f) : value;
}

float component(Component type, const unsigned char* bytes, bool normalized) {
  switch (type) {
    case Component::kByte:
      return scaled<std::int8_t>(bytes, normalized);
    case Component::kUbyte:
      return scaled<std::uint8_t>(bytes, normalized);
    case Component::kShort:
      return scaled<std::int16_t>(bytes, normalized);
    case Component::kUshort:
      return scaled<std::uint16_t>(bytes, normalized);
    case Component::kUint:
      return scaled<std::uint32_t>(bytes, normalized);
    case Component::kFloat:
      return load<float>(bytes);
  }
  return 0;
}

std::uint32_t index(Component type, const unsigned char* bytes) {
  if (type == Component::kUbyte) return *bytes;
  if (type == Component::kUshort) return load<std::uint16_t>(bytes);
  return load<std::uint32_t>(bytes);
}

bool is_index(Component type) {
  return type == Component::kUbyte || type == Component::kUshort || type == Component::kUint;
}

std::size_t size_of(Component type) {
  if (type == Component::kByte || type == Component::kUbyte) return 1;
  return type == Component::kShort || type == Component::kUshort ? 2 : 4;
}

// Calls set(element, its first byte) for each element that has data, in the order in which later ones win.
template <class Set>
void for_each_element(const Accessor& accessor, const Location& where, const std::string& what, const Set& set) {
  if (accessor.data) {
    for (std::size_t i = 0; i < accessor.count; ++i) set(i, accessor.data + i * accessor.stride);
  }
  const auto& sparse = accessor.sparse;
  const std::size_t index_size = size_of(sparse.index_type);
  const std::size_t size = size_of(accessor.type) * static_cast<std::size_t>(accessor.components);
  for (std::size_t i = 0; i < sparse.count; ++i) {
    const std::uint32_t element = index(sparse.index_type, sparse.indices + i * index_size);
    if (element >= accessor.count) {
      throw Error(where, what + ": a sparse accessor replaces element " + std::to_string(element) + " of " +
                             std::to_string(accessor.count));
    }
    set(element, sparse.values + i * size);
  }
}

}  // namespace

std::vector<float> read_floats(const Accessor& accessor, int components, const Location& where,
                               const std::string& what) {
  if (accessor.components != components) {
    throw Error(where, what + ": has " + std::to_string(accessor.components) + " components, and must have " +
                           std::to_string(components));
  }
  const auto width = static_cast<std::size_t>(components);
  std::vector<float> values(accessor.count * width);
  for_each_element(accessor, where, what, [&](std::size_t element, const unsigned char* bytes) {
    for (std::size_t c = 0; c < width; ++c) {
      const float x = component(accessor.type, bytes + c * size_of(accessor.type), accessor.normalized);
      if (!std::isfinite(x)) throw Error(where, what + ": element " + std::to_string(element) + " is not finite");
      values[element * width + c] = x;
    }
  });
  return values;
}

std::vector<std::uint32_t> read_indices(const Accessor& accessor, const Location& where, const std::string& what) {
  if (accessor.components != 1 || !is_index(accessor.type)) {
    throw Error(where, what + ": must be single unsigned integers");
  }
  std::vector<std::uint32_t> indices(accessor.count);
  for_each_element(accessor, where, what,
                   [&](std::size_t i, const unsigned char* bytes) { indices[i] = index(accessor.type, bytes); });
  return indices;
}

}  // namespace bdpt_tool::gltf
