// glTF files for tests: accessors in one buffer, which becomes a data URI.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace bdpt_tool {

inline std::string base64(const std::string& bytes) {
  static const char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t j = 0; j < 3; ++j) word = word << 8 | (i + j < bytes.size() ? std::uint8_t(bytes[i + j]) : 0);
    for (std::size_t j = 0; j < 4; ++j) text += i + j <= bytes.size() ? kDigits[word >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

class GltfBuffer {
 public:
  // Appends an accessor and its view; returns its index. `more` is further members, such as "\"normalized\":true".
  template <class T>
  int add(const std::string& type, const std::vector<T>& values, const std::string& more = "") {
    const std::size_t width = type == "SCALAR" ? 1 : static_cast<std::size_t>(type[3] - '0');
    const int view = add_bytes(std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
    return describe("\"bufferView\":" + std::to_string(view) + ",\"componentType\":" +
                    std::to_string(component_type<T>()) + ",\"count\":" + std::to_string(values.size() / width) +
                    ",\"type\":\"" + type + "\"" + (more.empty() ? "" : "," + more));
  }

  // An accessor by its members; returns its index.
  int describe(const std::string& members) {
    if (accessor_count_ > 0) accessors_ += ",";
    accessors_ += "{" + members + "}";
    return accessor_count_++;
  }

  // A view of bytes; returns its index. `more` as above.
  int add_bytes(const std::string& bytes, const std::string& more = "") {
    while (bytes_.size() % 4 != 0) bytes_ += '\0';
    if (view_count_ > 0) views_ += ",";
    views_ += "{\"buffer\":0,\"byteOffset\":" + std::to_string(bytes_.size()) +
              ",\"byteLength\":" + std::to_string(bytes.size()) + (more.empty() ? "" : "," + more) + "}";
    bytes_ += bytes;
    return view_count_++;
  }

  const std::string& bytes() const { return bytes_; }

  // The members buffers, bufferViews and accessors of a document; `uri` in place of the data itself, "-" = none.
  std::string members(const std::string& uri = "") const {
    std::string text = "\"buffers\":[{\"byteLength\":" + std::to_string(bytes_.size());
    if (uri != "-") text += ",\"uri\":\"" + (uri.empty() ? data_uri() : uri) + "\"";
    return text + "}],\"bufferViews\":[" + views_ + "],\"accessors\":[" + accessors_ + "]";
  }

 private:
  std::string data_uri() const { return "data:application/octet-stream;base64," + base64(bytes_); }

  template <class T>
  static int component_type() {
    if (std::is_same_v<T, float>) return 5126;
    const int width = sizeof(T) == 1 ? 5120 : sizeof(T) == 2 ? 5122 : 5124;
    return width + (std::is_unsigned_v<T> ? 1 : 0);
  }

  std::string bytes_, views_, accessors_;
  int view_count_ = 0, accessor_count_ = 0;
};

// A GLB of one JSON chunk, padded, and one chunk of binary data if there is any.
inline std::string glb(std::string json, std::string binary) {
  const auto word = [](std::size_t value) {
    std::string text(4, '\0');
    for (std::size_t i = 0; i < 4; ++i) text[i] = static_cast<char>(value >> 8 * i & 255);
    return text;
  };
  while (json.size() % 4 != 0) json += ' ';
  while (binary.size() % 4 != 0) binary += '\0';
  std::string chunks = word(json.size()) + "JSON" + json;
  if (!binary.empty()) chunks += word(binary.size()) + std::string("BIN\0", 4) + binary;
  return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

}  // namespace bdpt_tool
