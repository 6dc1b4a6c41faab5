// The header of a PLY file: which elements follow, and of which properties they are made.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "error.h"

namespace bdpt_tool {

enum class PlyEncoding { kAscii, kLittleEndian, kBigEndian };

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;  // of the value, or of the list's items
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  // of the list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  // The least number of bytes a binary record can have.
  std::size_t least_record_size() const;
  bool has_list() const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  // bytes up to the data
  int lines = 0;
};

// Throws an Error that names path and line.
PlyHeader parse_ply_header(std::string_view text, const std::string& path);

}  // namespace bdpt_tool
