// Reads OBJ files.
//
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <limits>
#include <unordered_map>

#include "default_view.h"
#include "file_data.h"
#include "mesh_scene.h"
#include "obj/mtl.h"
#include "obj/text_lines.h"
#include "polygon.h"

namespace bdpt_tool {
namespace obj {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// A corner of a face: its position, texture coordinates and normal.
using Corner = std::array<std::uint32_t, 3>;

struct CornerHash {
  std::size_t operator()(const Corner& c) const {
    return (std::size_t{c[0]} * 0x9E3779B97F4A7C15ull) ^ (std::size_t{c[1]} * 0xC2B2AE3D27D4EB4Full) ^
           (std::size_t{c[2]} * 0x165667B19E3779F9ull);
  }
};

class Reader {
 public:
  Reader(const std::string& path, const ReadOptions& options, Diagnostics& diagnostics)
      : path_(path), folder_(path, options.folder), notes_(path, diagnostics), materials_(scene_, folder_, notes_) {
    scene_.path = path;
  }

  SceneDescription read() {
    const FileData file(path_);
    const std::string text = decoded(file.text(), path_);
    LineReader lines(text, path_);
    while (const std::optional<Line> line = lines.next()) execute(*line);
    end_part();
    if (scene_.instances.empty()) throw Error(Location{path_, 0}, "there are no faces in it; it needs a mesh");
    complete(scene_, false, notes_);
    notes_.tell();
    return std::move(scene_);
  }

 private:
  void execute(const Line& line) {
    const std::string_view keyword = line.keyword;
    if (keyword == "v") {
      read_position(line);
    } else if (keyword == "vt") {
      const std::vector<float> n = numbers(line, 1);
      uv_.insert(uv_.end(), {n[0], n.size() > 1 ? n[1] : 0});
    } else if (keyword == "vn") {
      const std::vector<float> n = numbers(line, 3);
      normals_.insert(normals_.end(), n.begin(), n.begin() + 3);
    } else if (keyword == "f") {
      read_face(line);
    } else if (keyword == "g" || keyword == "o") {
      end_part();
      group_ = line.rest;
    } else if (keyword == "usemtl") {
      end_part();
      material_ = line.rest;
      material_from_ = line.where;
    } else if (keyword == "mtllib") {
      read_library(line);
    } else if (keyword == "p" || keyword == "l") {
      notes_.add("points and lines are left out");
    } else if (keyword != "s" && keyword != "mg" && keyword != "lod" && keyword != "shadow_obj" &&
               keyword != "trace_obj") {
      unknown(line);
    }
  }

  // What is a part of the format and no polygon, and what is no part of it.
  void unknown(const Line& line) {
    static constexpr std::string_view kKnown[] = {
        "vp",   "cstype", "deg", "bmat", "step",  "curv",   "curv2",  "surf",  "parm",  "trim",     "hole",
        "scrv", "sp",     "end", "con",  "bevel", "usemap", "maplib", "ctech", "stech", "c_interp", "d_interp"};
    if (std::find(std::begin(kKnown), std::end(kKnown), line.keyword) == std::end(kKnown)) {
      throw Error(line.where, "unknown statement '" + std::string(line.keyword.substr(0, 40)) + "'");
    }
    notes_.add("'" + std::string(line.keyword) + "' of OBJ is left out");
  }

  // Three numbers; a weight after them, which is for curves alone, or a colour.
  void read_position(const Line& line) {
    const std::vector<float> n = numbers(line, 3);
    positions_.insert(positions_.end(), n.begin(), n.begin() + 3);
    if (n.size() >= 6) {
      colors_.resize(positions_.size() - 3, 1.0f);
      colors_.insert(colors_.end(), n.begin() + 3, n.begin() + 6);
    }
  }

  // Of a missing file the meshes are as good as ever.
  void read_library(const Line& line) {
    std::string name(line.rest);
    std::replace(name.begin(), name.end(), '\\', '/');
    const std::string path = folder_.path_of(name, line.where);
    if (!std::filesystem::exists(path)) {
      notes_.add("the file of materials is not there, and its materials become grey", "'" + name + "'");
      return;
    }
    materials_.read(path, line.where);
  }

  void read_face(const Line& line) {
    corners_.clear();
    for (const std::string_view word : line.words()) {
      corners_.push_back(vertex(read_corner(word, line.where)));
    }
    if (corners_.size() < 3) throw Error(line.where, "a face needs three corners");
    if (corners_.size() > kMaxCorners) {
      throw Error(line.where, "a face of more than " + std::to_string(kMaxCorners) + " corners; triangulate the mesh");
    }
    triangulate(mesh_.positions, corners_, mesh_.indices);
  }

  // "v", "v/t", "v//n" or "v/t/n"; from 1 on, or negative from the last back.
  Corner read_corner(std::string_view word, const Location& where) const {
    static constexpr const char* kNames[3] = {"v", "vt", "vn"};
    const std::size_t counts[3] = {positions_.size() / 3, uv_.size() / 2, normals_.size() / 3};
    Corner corner = {kNone, kNone, kNone};
    const std::string whole(word.substr(0, 40));
    for (std::size_t part = 0; part < 3; ++part) {
      const std::size_t slash = std::min(word.find('/'), word.size());
      const std::string_view text = word.substr(0, slash);
      word.remove_prefix(std::min(slash + 1, word.size()));
      if (text.empty()) continue;
      long long index = 0;
      const auto result = std::from_chars(text.data(), text.data() + text.size(), index);
      if (result.ec != std::errc() || result.ptr != text.data() + text.size()) {
        throw Error(where, "'" + whole + "' is no corner of a face");
      }
      const auto count = static_cast<long long>(counts[part]);
      if (index < 0) index += count + 1;
      if (index < 1 || index > count) {
        throw Error(where, "'" + whole + "': there is no " + kNames[part] + " " + std::string(text) + ", there are " +
                               std::to_string(count) + " before this line");
      }
      corner[part] = static_cast<std::uint32_t>(index - 1);
    }
    if (!word.empty() || corner[0] == kNone) throw Error(where, "'" + whole + "' is no corner of a face");
    return corner;
  }

  std::uint32_t vertex(const Corner& corner) {
    const auto [found, added] = vertices_.emplace(corner, static_cast<std::uint32_t>(mesh_.vertex_count()));
    if (!added) return found->second;
    append(positions_, corner[0], 3, 0, mesh_.positions);
    append(uv_, corner[1], 2, 0, mesh_.uv);
    append(normals_, corner[2], 3, 0, mesh_.normals);
    has_uv_ = has_uv_ || corner[1] != kNone;
    has_normals_ = has_normals_ || corner[2] != kNone;
    if (!colors_.empty()) {
      const bool known = 3 * std::size_t{corner[0]} < colors_.size();
      append(colors_, known ? corner[0] : kNone, 3, 1, mesh_.colors);
      mesh_.colors.push_back(1);
    }
    return found->second;
  }

  static void append(const std::vector<float>& from, std::uint32_t index, std::size_t width, float fallback,
                     std::vector<float>& to) {
    if (index == kNone) {
      to.insert(to.end(), width, fallback);
    } else {
      const auto begin = from.begin() + static_cast<std::ptrdiff_t>(width * index);
      to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
    }
  }

  int material(bool colored) {
    int index = material_from_.file.empty() ? -1 : materials_.find(material_);
    if (index < 0) {
      if (!material_from_.file.empty()) {
        notes_.add("materials that are in no file become grey", "'" + material_ + "'");
      }
      if (grey_ < 0) {
        grey_ = static_cast<int>(scene_.materials.size());
        MaterialDescription grey;
        grey.label = "grey";
        grey.where = {path_, 0};
        scene_.materials.push_back(std::move(grey));
      }
      index = grey_;
    }
    auto& description = scene_.materials[static_cast<std::size_t>(index)];
    if (colored && !description.uses_vertex_colors) description.uses_vertex_colors = true;
    return index;
  }

  // A part is what lies between two groups or materials.
  void end_part() {
    if (mesh_.indices.empty()) return;
    if (!has_uv_) mesh_.uv.clear();
    if (!has_normals_) mesh_.normals.clear();
    if (mesh_.colors.size() != 4 * mesh_.vertex_count()) mesh_.colors.clear();
    if (repair_zero_normals(mesh_) > 0) notes_.add("normals that are missing are made from the triangles", group_);
    const int material_index = material(!mesh_.colors.empty());
    std::string label = group_.empty() ? "mesh" : group_;
    const std::size_t number = scene_.instances.size();
    scene_.shapes.push_back({label, {path_, 0}, std::move(mesh_)});
    scene_.instances.push_back({static_cast<int>(scene_.shapes.size()) - 1,
                                material_index,
                                {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
                                {path_, 0},
                                label,
                                number,
                                label});
    mesh_ = TriangleMesh();
    vertices_.clear();
    has_uv_ = has_normals_ = false;
  }

  static constexpr std::size_t kMaxCorners = 4096;  // cutting takes the square of it, and worse

  std::string path_;
  SceneFolder folder_;
  SceneDescription scene_;
  Notes notes_;
  MaterialLibrary materials_;
  std::vector<float> positions_, uv_, normals_, colors_;
  std::string group_, material_;
  Location material_from_;
  int grey_ = -1;
  TriangleMesh mesh_;
  std::unordered_map<Corner, std::uint32_t, CornerHash> vertices_;
  bool has_uv_ = false, has_normals_ = false;
  std::vector<std::uint32_t> corners_;
};

}  // namespace
}  // namespace obj

SceneDescription read_obj_scene(const std::string& path, const ReadOptions& options, Diagnostics& diagnostics) {
  return obj::Reader(path, options, diagnostics).read();
}

}  // namespace bdpt_tool
