// SPDX-License-Identifier: Apache-2.0
#include "gltf/container.h"

#include <cstdint>

#include "error.h"

namespace bdpt_tool::gltf {
namespace {

constexpr std::size_t kHeaderSize = 12, kChunkHeaderSize = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

std::uint32_t word(std::string_view data, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(data[offset + i]);
  return value;
}

std::string bytes(std::size_t count) { return std::to_string(count) + (count == 1 ? " byte" : " bytes"); }

class Glb {
 public:
  Glb(const std::string& path, std::string_view data) : path_(path), data_(data) {}

  Container open() {
    check_header();
    Container container;
    container.is_glb = true;
    for (std::size_t offset = kHeaderSize; offset < data_.size();) {
      const std::string_view chunk = chunk_at(offset);
      const std::uint32_t type = word(data_, offset + 4);
      const bool first = offset == kHeaderSize;
      if (first != (type == kJsonChunk)) fail("the first chunk must hold JSON, and no other");
      if (first) container.json = chunk;
      if (type == kBinaryChunk) {
        if (container.has_binary) fail("there are two chunks of binary data");
        if (offset != kHeaderSize + kChunkHeaderSize + container.json.size()) {
          fail("the chunk of binary data must be the second");
        }
        container.has_binary = true;
      }
      offset += kChunkHeaderSize + chunk.size();
    }
    if (container.json.empty()) fail("there is no JSON in it");
    return container;
  }

 private:
  [[noreturn]] void fail(const std::string& text) const { throw Error(Location{path_, 0}, "damaged GLB: " + text); }

  void check_header() const {
    if (data_.size() < kHeaderSize) fail("its " + bytes(data_.size()) + " hold no header");
    if (!data_.starts_with("glTF")) fail("it does not begin with 'glTF'");
    const std::uint32_t version = word(data_, 4), length = word(data_, 8);
    if (version != 2) {
      fail("it is of version " + std::to_string(version) + ", and this program reads version 2; export it anew");
    }
    if (length != data_.size()) {
      fail("its header tells of " + bytes(length) + ", the file has " + bytes(data_.size()));
    }
  }

  std::string_view chunk_at(std::size_t offset) const {
    const std::size_t rest = data_.size() - offset;
    if (rest < kChunkHeaderSize) fail("it ends within the header of a chunk, at byte " + std::to_string(offset));
    const std::uint32_t length = word(data_, offset);
    if (length > rest - kChunkHeaderSize) {
      fail("the chunk at byte " + std::to_string(offset) + " has " + bytes(length) + ", the file has " +
           bytes(rest - kChunkHeaderSize) + " left");
    }
    if (length % 4 != 0) fail("the length of the chunk at byte " + std::to_string(offset) + " is no multiple of 4");
    return data_.substr(offset + kChunkHeaderSize, length);
  }

  std::string path_;
  std::string_view data_;
};

}  // namespace

std::string with_json(std::string_view data, const Container& container, std::string json) {
  if (!container.is_glb) return json;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string_view rest = data.substr(kHeaderSize + kChunkHeaderSize + container.json.size());
  std::string file = "glTF";
  for (const std::size_t number : {std::size_t{2}, kHeaderSize + kChunkHeaderSize + json.size() + rest.size(),
                                   json.size(), std::size_t{kJsonChunk}}) {
    for (std::size_t i = 0; i < 4; ++i) file += static_cast<char>(number >> (8 * i) & 255);
  }
  return file.append(json).append(rest);
}

Container open_container(const std::string& path, std::string_view data) {
  if (data.starts_with("glTF") || path.ends_with(".glb")) return Glb(path, data).open();
  return {data};
}

}  // namespace bdpt_tool::gltf
