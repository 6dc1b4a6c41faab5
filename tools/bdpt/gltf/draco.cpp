// SPDX-License-Identifier: Apache-2.0
#include "gltf/draco.h"

#include "gltf/schema_checker.h"

#ifdef BDPT_DRACO
#include <draco/compression/config/compression_shared.h>
#include <draco/compression/decode.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#endif

namespace bdpt_tool::gltf {

std::string with_packed_indices_apart(std::string_view json) {
  Json document = Json::parse(json);
  const auto meshes = document.find("meshes");
  if (meshes == document.end()) return std::string(json);
  for (Json& mesh : *meshes) {
    for (Json& primitive : mesh["primitives"]) {
      const auto extensions = primitive.find("extensions");
      if (extensions == primitive.end() || !extensions->contains("KHR_draco_mesh_compression")) continue;
      Json& draco = (*extensions)["KHR_draco_mesh_compression"];
      draco.erase("indices");
      if (primitive.contains("indices")) draco["indices"] = primitive["indices"];
      primitive.erase("indices");
    }
  }
  return document.dump();
}

#ifdef BDPT_DRACO

const bool kReadsDraco = true;

namespace {

// A flat grid has up to twelve triangles to a byte; what promises so much more is damaged.
constexpr std::size_t kMostInAByte = 100;

struct Counts {
  std::size_t faces = 0, vertices = 0;
  bool are_all_vertices = false;  // else seams of attributes add more
};

// What the head of the data promises. Draco allocates that before it has seen the rest.
std::optional<Counts> promised(std::span<const unsigned char> data) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(data.data()), data.size(), draco::kDracoMeshBitstreamVersion);
  char magic[5];
  std::uint8_t major = 0, minor = 0, type = 0, method = 0, traversal = 0;
  std::uint16_t flags = 0;
  if (!buffer.Decode(magic, sizeof magic) || std::memcmp(magic, "DRACO", sizeof magic) != 0) return std::nullopt;
  if (!buffer.Decode(&major) || !buffer.Decode(&minor) || !buffer.Decode(&type) || !buffer.Decode(&method) ||
      !buffer.Decode(&flags)) {
    return std::nullopt;
  }
  if (major != draco::kDracoMeshBitstreamVersionMajor || minor != draco::kDracoMeshBitstreamVersionMinor ||
      type != draco::TRIANGULAR_MESH) {
    return std::nullopt;
  }
  draco::GeometryMetadata metadata;
  if ((flags & METADATA_FLAG_MASK) && !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
    return std::nullopt;
  std::uint32_t first = 0, second = 0;
  const bool sequential = method == draco::MESH_SEQUENTIAL_ENCODING;
  if (!sequential && !buffer.Decode(&traversal)) return std::nullopt;
  if (!draco::DecodeVarint(&first, &buffer) || !draco::DecodeVarint(&second, &buffer)) return std::nullopt;
  return sequential ? Counts{first, second, true} : Counts{second, first, false};
}

class Unpacker {
 public:
  Unpacker(const Location& where, const std::string& at, Document& document, Primitive& primitive)
      : where_(where), at_(at), document_(document), primitive_(primitive) {}

  void unpack(std::span<const unsigned char> data, const std::map<std::string, int>& ids) {
    check(data, ids);
    const std::unique_ptr<draco::Mesh> mesh = decode(data);
    if (mesh->num_faces() * std::size_t{3} != index_count_ || mesh->num_points() != vertex_count_)
      fail("has " + counts(mesh->num_faces(), mesh->num_points()));
    for (const auto& [name, id] : ids) {
      const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
      if (!attribute) fail("holds no attribute " + std::to_string(id) + ", which " + name + " is to be");
      set_attribute(name, *attribute);
    }
    set_indices(*mesh);
  }

 private:
  [[noreturn]] void fail(const std::string& text) const {
    throw Error(where_, at_ + ": the data of KHR_draco_mesh_compression " + text);
  }

  std::string counts(std::size_t faces, std::size_t vertices) const {
    return std::to_string(faces) + " triangles of " + std::to_string(vertices) + " vertices, and the accessors " +
           std::to_string(index_count_ / 3) + " of " + std::to_string(vertex_count_);
  }

  const Accessor& accessor(int index) const { return document_.accessors[static_cast<std::size_t>(index)]; }

  // Everything that says how much memory it will take.
  void check(std::span<const unsigned char> data, const std::map<std::string, int>& ids) {
    if (primitive_.mode != Mode::kTriangles || primitive_.indices < 0) fail("must be of triangles with indices");
    if (!ids.contains("POSITION")) fail("must have a POSITION");
    for (const auto& [name, id] : ids) {
      if (primitive_.attribute(name) < 0) fail("has a " + name + ", and the primitive none");
      if (accessor(primitive_.attribute(name)).sparse.count > 0)
        fail("is for the accessor of " + name + ", and that is sparse");
    }
    index_count_ = accessor(primitive_.indices).count;
    vertex_count_ = accessor(primitive_.attribute("POSITION")).count;
    for (const auto& [name, id] : ids) {
      if (accessor(primitive_.attribute(name)).count != vertex_count_)
        fail("has other than " + std::to_string(vertex_count_) + " elements for " + name);
    }
    const std::optional<Counts> head = promised(data);
    if (!head) fail("is damaged, or not of Draco's version 2.2");
    const bool fits = head->are_all_vertices ? head->vertices == vertex_count_ : head->vertices <= vertex_count_;
    if (!fits || head->faces * 3 != index_count_) fail("has " + counts(head->faces, head->vertices));
    if (std::max(head->faces, vertex_count_) / kMostInAByte > data.size())
      fail("is damaged: its " + std::to_string(data.size()) + " bytes cannot hold " +
           counts(head->faces, head->vertices));
  }

  std::unique_ptr<draco::Mesh> decode(std::span<const unsigned char> data) const {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(data.data()), data.size());
    try {
      auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
      if (!mesh.ok()) fail("is damaged: " + mesh.status().error_msg_string());
      return std::move(mesh).value();
    } catch (const Error&) {
      throw;
    } catch (const std::exception& error) {
      fail(std::string("is damaged: ") + error.what());
    }
  }

  // An accessor of numbers that lie here.
  int add(Accessor to, Bytes&& bytes, std::size_t size) {
    document_.storage.push_back(std::move(bytes));
    to.data = document_.storage.back().data();
    to.stride = size;
    document_.accessors.push_back(to);
    return static_cast<int>(document_.accessors.size()) - 1;
  }

  template <class T>
  void convert(const std::string& name, const draco::PointAttribute& attribute) {
    const Accessor to = accessor(primitive_.attribute(name));
    const auto width = static_cast<std::size_t>(to.components);
    Bytes bytes(vertex_count_ * width * sizeof(T));
    std::vector<T> element(width);
    for (std::size_t i = 0; i < vertex_count_; ++i) {
      const auto index = attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
      if (index.value() >= attribute.size() ||
          !attribute.ConvertValue<T>(index, static_cast<std::int8_t>(width), element.data())) {
        fail("has a " + name + " that its accessor cannot say");
      }
      std::memcpy(&bytes[i * width * sizeof(T)], element.data(), width * sizeof(T));
    }
    primitive_.attributes[name] = add(to, std::move(bytes), width * sizeof(T));
  }

  void set_attribute(const std::string& name, const draco::PointAttribute& attribute) {
    const Accessor& to = accessor(primitive_.attribute(name));
    if (attribute.num_components() != to.components)
      fail("has " + std::to_string(attribute.num_components()) + " components for " + name + ", and the accessor " +
           std::to_string(to.components));
    switch (to.type) {
      case Component::kByte:
        return convert<std::int8_t>(name, attribute);
      case Component::kUbyte:
        return convert<std::uint8_t>(name, attribute);
      case Component::kShort:
        return convert<std::int16_t>(name, attribute);
      case Component::kUshort:
        return convert<std::uint16_t>(name, attribute);
      case Component::kUint:
        return convert<std::uint32_t>(name, attribute);
      case Component::kFloat:
        return convert<float>(name, attribute);
    }
  }

  void set_indices(const draco::Mesh& mesh) {
    Accessor to;
    to.count = index_count_;
    to.type = Component::kUint;
    Bytes bytes(index_count_ * sizeof(std::uint32_t));
    for (std::size_t i = 0; i < index_count_; ++i) {
      const std::uint32_t vertex = mesh.face(draco::FaceIndex(static_cast<std::uint32_t>(i / 3)))[i % 3].value();
      std::memcpy(&bytes[i * sizeof vertex], &vertex, sizeof vertex);
    }
    primitive_.indices = add(to, std::move(bytes), sizeof(std::uint32_t));
  }

  const Location& where_;
  const std::string& at_;
  Document& document_;
  Primitive& primitive_;
  std::size_t index_count_ = 0, vertex_count_ = 0;
};

}  // namespace

void unpack_draco(std::span<const unsigned char> data, const std::map<std::string, int>& ids, const Location& where,
                  const std::string& at, Document& document, Primitive& primitive) {
  Unpacker(where, at, document, primitive).unpack(data, ids);
}

#else

const bool kReadsDraco = false;

void unpack_draco(std::span<const unsigned char>, const std::map<std::string, int>&, const Location& where,
                  const std::string& at, Document&, Primitive&) {
  throw Error(where, at + ": this program was built without Draco");
}

#endif

}  // namespace bdpt_tool::gltf
