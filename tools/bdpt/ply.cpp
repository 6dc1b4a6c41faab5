// SPDX-License-Identifier: Apache-2.0
#include "ply.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>

#include "default_view.h"
#include "file_data.h"
#include "image.h"
#include "mesh_scene.h"
#include "ply_header.h"
#include "polygon.h"

namespace bdpt_tool {
namespace {

// Hands out the numbers of the data part one after another, whatever the encoding.
class ScalarStream {
 public:
  ScalarStream(std::string_view data, const PlyHeader& header, const std::string& path)
      : at_(data.data() + header.size),
        end_(data.data() + data.size()),
        encoding_(header.encoding),
        where_{path, header.encoding == PlyEncoding::kAscii ? header.lines + 1 : 0} {}

  [[noreturn]] void fail(const std::string& text) const { throw Error(where_, text); }

  std::uint64_t remaining() const { return static_cast<std::uint64_t>(end_ - at_); }

  double next(PlyType type) {
    if (encoding_ == PlyEncoding::kAscii) return next_ascii(type);
    switch (type) {
      case PlyType::kInt8:
        return next_binary<std::int8_t>();
      case PlyType::kUint8:
        return next_binary<std::uint8_t>();
      case PlyType::kInt16:
        return next_binary<std::int16_t>();
      case PlyType::kUint16:
        return next_binary<std::uint16_t>();
      case PlyType::kInt32:
        return next_binary<std::int32_t>();
      case PlyType::kUint32:
        return next_binary<std::uint32_t>();
      case PlyType::kFloat32:
        return next_binary<float>();
      case PlyType::kFloat64:
        return next_binary<double>();
    }
    return 0;
  }

  // An element cannot have more records than there are bytes left for them.
  void check_count(const PlyElement& element) const {
    const std::uint64_t least =
        encoding_ == PlyEncoding::kAscii ? 2 * element.properties.size() : element.least_record_size();
    const std::uint64_t have = remaining() + (encoding_ == PlyEncoding::kAscii ? 1 : 0);
    if (least > 0 && element.count > have / least) {
      fail("the file is too short for " + std::to_string(element.count) + " records of '" + element.name +
           "'; it is cut off or damaged");
    }
  }

 private:
  template <class T>
  T next_binary() {
    if (remaining() < sizeof(T)) fail("the file ends too early; it is cut off or damaged");
    char bytes[sizeof(T)];
    std::memcpy(bytes, at_, sizeof(T));
    const bool file_is_little = encoding_ == PlyEncoding::kLittleEndian;
    if (file_is_little != (std::endian::native == std::endian::little)) std::reverse(bytes, bytes + sizeof(T));
    at_ += sizeof(T);
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  double next_ascii(PlyType type) {
    while (at_ < end_ && (*at_ == ' ' || *at_ == '\t' || *at_ == '\r' || *at_ == '\n')) {
      if (*at_++ == '\n') ++where_.line;
    }
    if (at_ == end_) fail("the file ends too early; it is cut off or damaged");
    double value = 0;
    const auto result = std::from_chars(*at_ == '+' ? at_ + 1 : at_, end_, value);
    // Numbers too small for a double read as zero; those too large are not finite and refused where it matters.
    if (result.ec == std::errc::result_out_of_range) {
      value = 0;
    } else if (result.ec != std::errc()) {
      fail("expected a number");
    }
    at_ = result.ptr;
    if (type < PlyType::kFloat32 && value != std::floor(value)) fail("expected a whole number");
    return value;
  }

  const char* at_;
  const char* end_;
  PlyEncoding encoding_;
  Location where_;
};

constexpr int kSlots = 12;
constexpr int kMaxCorners = 4096;  // cutting takes the square of it, and worse

class MeshReader {
 public:
  MeshReader(std::string_view data, const std::string& path)
      : header_(parse_ply_header(data, path)), stream_(data, header_, path) {}

  TriangleMesh read() {
    for (const PlyElement& element : header_.elements) {
      stream_.check_count(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        skip(element);
      }
    }
    if (mesh_.positions.empty()) stream_.fail("no vertices; only triangle meshes can be read");
    if (mesh_.indices.empty()) stream_.fail("no faces; only triangle meshes can be read");
    check_indices();
    return std::move(mesh_);
  }

 private:
  static int find(const PlyElement& element, std::initializer_list<std::string_view> names) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      for (std::string_view name : names) {
        if (property.name == name && !property.is_list) return static_cast<int>(i);
      }
    }
    return -1;
  }

  // Where each property goes: 0-2 position, 3-5 normal, 6-7 uv, 8-11 colour, -1 nowhere.
  std::vector<int> slots(const PlyElement& element) {
    const int found[kSlots] = {find(element, {"x"}),
                               find(element, {"y"}),
                               find(element, {"z"}),
                               find(element, {"nx"}),
                               find(element, {"ny"}),
                               find(element, {"nz"}),
                               find(element, {"u", "s", "texture_u", "texture_s"}),
                               find(element, {"v", "t", "texture_v", "texture_t"}),
                               find(element, {"red", "r", "diffuse_red"}),
                               find(element, {"green", "g", "diffuse_green"}),
                               find(element, {"blue", "b", "diffuse_blue"}),
                               find(element, {"alpha", "a"})};
    if (found[0] < 0 || found[1] < 0 || found[2] < 0) stream_.fail("vertices without x, y and z");
    has_normals_ = found[3] >= 0 && found[4] >= 0 && found[5] >= 0;
    has_uv_ = found[6] >= 0 && found[7] >= 0;
    has_colors_ = found[8] >= 0 && found[9] >= 0 && found[10] >= 0;
    std::vector<int> slots(element.properties.size(), -1);
    for (int i = 0; i < kSlots; ++i) {
      if (found[i] >= 0) slots[found[i]] = i;
    }
    return slots;
  }

  void read_vertices(const PlyElement& element) {
    if (!mesh_.positions.empty()) stream_.fail("more than one element 'vertex'");
    if (element.count > std::numeric_limits<std::uint32_t>::max()) stream_.fail("too many vertices for 32-bit indices");
    const std::vector<int> slot = slots(element);
    // Four floats more, for the slack the library likes behind the data.
    mesh_.positions.reserve(3 * element.count + 4);
    if (has_normals_) mesh_.normals.reserve(3 * element.count + 4);
    if (has_uv_) mesh_.uv.reserve(2 * element.count + 4);
    if (has_colors_) mesh_.colors.reserve(4 * element.count + 4);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      float value[kSlots] = {};
      value[kSlots - 1] = 1;  // opaque
      for (std::size_t p = 0; p < slot.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (property.is_list) {
          skip_list(property);
          continue;
        }
        const double number = stream_.next(property.type);
        if (slot[p] >= 0)
          value[slot[p]] = static_cast<float>(slot[p] < 8 ? number : color(number, property.type, slot[p] < 11));
      }
      store_vertex(value, i);
    }
  }

  // Whole numbers are parts of their greatest, colours in the sRGB curve; floats are linear.
  static double color(double number, PlyType type, bool curved) {
    if (type >= PlyType::kFloat32) return number;
    const double part = number / (type == PlyType::kUint8 ? 255 : type == PlyType::kUint16 ? 65535 : 4294967295.0);
    return curved ? static_cast<double>(srgb_to_linear(static_cast<float>(part))) : part;
  }

  void store_vertex(const float (&value)[kSlots], std::uint64_t index) {
    for (int i = 0; i < kSlots; ++i) {
      if (!std::isfinite(value[i])) {
        static constexpr const char* kNames[kSlots] = {"x", "y", "z",   "nx",    "ny",   "nz",
                                                       "u", "v", "red", "green", "blue", "alpha"};
        stream_.fail("vertex " + std::to_string(index) + ": " + kNames[i] + " is not finite");
      }
    }
    mesh_.positions.insert(mesh_.positions.end(), value, value + 3);
    if (has_normals_) mesh_.normals.insert(mesh_.normals.end(), value + 3, value + 6);
    if (has_uv_) mesh_.uv.insert(mesh_.uv.end(), value + 6, value + 8);
    if (has_colors_) mesh_.colors.insert(mesh_.colors.end(), value + 8, value + kSlots);
  }

  void read_faces(const PlyElement& element) {
    const PlyProperty* list = nullptr;
    for (const PlyProperty& property : element.properties) {
      if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index")) list = &property;
    }
    if (!list) stream_.fail("faces without a list 'vertex_indices'");
    mesh_.indices.reserve(3 * expected_triangles(element, *list) + 4);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (&property == list) {
          read_face(property, i);
        } else if (property.is_list) {
          skip_list(property);
        } else {
          stream_.next(property.type);
        }
      }
    }
  }

  // What the rest of a binary file holds where nothing else is in it: a face is cut into two triangles less than it has
  // corners.
  std::uint64_t expected_triangles(const PlyElement& element, const PlyProperty& list) const {
    const bool alone = element.properties.size() == 1 && &element == &header_.elements.back();
    if (!alone || header_.encoding == PlyEncoding::kAscii) return element.count;
    const std::uint64_t corners = (stream_.remaining() - element.count * size_of(list.count_type)) / size_of(list.type);
    return std::max(element.count, corners - std::min(corners, 2 * element.count));
  }

  void read_face(const PlyProperty& property, std::uint64_t index) {
    const double corners = stream_.next(property.count_type);
    if (!(corners >= 3 && corners <= kMaxCorners)) {
      stream_.fail("face " + std::to_string(index) + " has " + std::to_string(static_cast<long long>(corners)) +
                   " corners, and must have 3 to " + std::to_string(kMaxCorners) + "; triangulate the mesh");
    }
    face_.clear();
    for (int i = 0; i < static_cast<int>(corners); ++i) {
      face_.push_back(index_of(stream_.next(property.type), index));
      if (face_.back() >= mesh_.vertex_count() && corners > 4) {
        stream_.fail("face " + std::to_string(index) + ": vertex " + std::to_string(face_.back()) +
                     " does not exist, there are " + std::to_string(mesh_.vertex_count()) + " before it");
      }
    }
    if (corners == 4) {
      mesh_.indices.insert(mesh_.indices.end(), {face_[0], face_[1], face_[2], face_[0], face_[2], face_[3]});
    } else {
      triangulate(mesh_.positions, face_, mesh_.indices);
    }
  }

  std::uint32_t index_of(double value, std::uint64_t face) const {
    if (!(value >= 0 && value < 4294967295.0)) {
      stream_.fail("face " + std::to_string(face) + ": a vertex index is out of range");
    }
    return static_cast<std::uint32_t>(value);
  }

  void skip_list(const PlyProperty& property) {
    const double length = stream_.next(property.count_type);
    if (!(length >= 0) || length > static_cast<double>(stream_.remaining())) {
      stream_.fail("the list '" + property.name + "' is longer than the file; it is damaged");
    }
    for (double i = 0; i < length; ++i) stream_.next(property.type);
  }

  void skip(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (property.is_list) {
          skip_list(property);
        } else {
          stream_.next(property.type);
        }
      }
    }
  }

  void check_indices() const {
    for (std::size_t i = 0; i < mesh_.indices.size(); ++i) {
      if (mesh_.indices[i] >= mesh_.vertex_count()) {
        stream_.fail("triangle " + std::to_string(i / 3) + ": vertex " + std::to_string(mesh_.indices[i]) +
                     " does not exist, there are " + std::to_string(mesh_.vertex_count()));
      }
    }
  }

  PlyHeader header_;
  ScalarStream stream_;
  TriangleMesh mesh_;
  bool has_normals_ = false;
  bool has_uv_ = false;
  bool has_colors_ = false;
  std::vector<std::uint32_t> face_;
};

}  // namespace

TriangleMesh parse_ply(std::string_view data, const std::string& path) { return MeshReader(data, path).read(); }

TriangleMesh read_ply(const std::string& path, const Location& from) {
  const FileData file(path, from);
  return parse_ply(file.text(), path);
}

SceneDescription read_ply_scene(const std::string& path, const ReadOptions&, Diagnostics& diagnostics) {
  const Location where{path, 0};
  Notes notes(path, diagnostics);
  SceneDescription scene;
  scene.path = path;
  TriangleMesh mesh = read_ply(path);
  if (repair_zero_normals(mesh) > 0) notes.add("normals of length zero are made from the triangles");
  MaterialDescription grey;
  grey.label = "grey";
  grey.where = where;
  grey.uses_vertex_colors = !mesh.colors.empty();
  if (grey.uses_vertex_colors) grey.reflectance = {1, 1, 1};
  const std::string label = std::filesystem::path(path).stem().string();
  scene.shapes.push_back({label, where, std::move(mesh)});
  scene.materials.push_back(std::move(grey));
  scene.instances.push_back({0, 0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, where, label, 0, label});
  complete(scene, false, notes);
  notes.tell();
  return scene;
}

}  // namespace bdpt_tool
