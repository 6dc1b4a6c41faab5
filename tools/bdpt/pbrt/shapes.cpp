// SPDX-License-Identifier: Apache-2.0
#include "pbrt/shapes.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "parallel.h"
#include "ply.h"

namespace bdpt_tool {
namespace {

TriangleMesh inline_mesh(const ParamList& params, Diagnostics& diagnostics) {
  TriangleMesh mesh;
  mesh.positions = params.get_tuples("P", 3);
  mesh.normals = params.get_tuples("N", 3);
  mesh.uv = params.get_tuples("uv", 2);
  mesh.indices = params.get_indices("indices");
  params.warn_ignored("S", "is not used: tangents follow uv", diagnostics);
  params.ignore("faceIndices");
  const std::size_t vertices = mesh.vertex_count();
  if (vertices == 0) params.fail("\"point3 P\" is missing");
  if (!params.has("indices")) {
    if (vertices != 3) params.fail("\"integer indices\" is missing");
    mesh.indices = {0, 1, 2};
  }
  if (mesh.indices.empty() || mesh.indices.size() % 3 != 0) {
    params.fail("the number of indices must be a multiple of 3, and not 0");
  }
  if (!mesh.normals.empty() && mesh.normals.size() != 3 * vertices)
    params.fail("N must have as many normals as P points");
  if (!mesh.uv.empty() && mesh.uv.size() != 2 * vertices) params.fail("uv must have as many pairs as P points");
  const std::uint32_t greatest = *std::max_element(mesh.indices.begin(), mesh.indices.end());
  if (greatest >= vertices) {
    params.fail("vertex " + std::to_string(greatest) + " does not exist, there are " + std::to_string(vertices));
  }
  return mesh;
}

}  // namespace

int ShapeTable::push(std::string label, const Location& where, TriangleMesh mesh) {
  scene_.shapes.push_back({std::move(label), where, std::move(mesh)});
  return static_cast<int>(scene_.shapes.size()) - 1;
}

void ShapeTable::repair(ShapeDescription& shape) {
  if (const std::size_t repaired = repair_zero_normals(std::get<TriangleMesh>(shape.geometry))) {
    diagnostics_.warn(shape.where, shape.label + ": " + std::to_string(repaired) +
                                       " normals of length zero, made from the triangles");
  }
}

void ShapeTable::read_files() {
  parallel_for(files_.size(), [&](std::size_t i) {
    const File& file = files_[i];
    TriangleMesh mesh = read_ply(file.path, file.from);
    if (file.turned) turn_over(mesh);
    scene_.shapes[static_cast<std::size_t>(file.shape)].geometry = std::move(mesh);
  });
  for (const File& file : files_) repair(scene_.shapes[static_cast<std::size_t>(file.shape)]);
  files_.clear();
}

int ShapeTable::add_sphere(const ParamList& params) {
  const float radius = params.get_float("radius", 1);
  if (!(radius > 0)) params.fail("the radius must be greater than zero");
  const bool full = params.get_float("zmin", -radius) <= -radius && params.get_float("zmax", radius) >= radius &&
                    params.get_float("phimax", 360) >= 360;
  if (!full) params.fail("only whole spheres are known; remove zmin, zmax and phimax, or give a mesh");
  const auto found = spheres_.find(radius);
  if (found != spheres_.end()) return found->second;
  scene_.shapes.push_back({"sphere", params.where(), SphereShape{radius}});
  return spheres_[radius] = static_cast<int>(scene_.shapes.size()) - 1;
}

int ShapeTable::add_inline_mesh(const ParamList& params, bool turned) {
  const Location& where = params.where();
  TriangleMesh mesh = inline_mesh(params, diagnostics_);
  if (turned) turn_over(mesh);
  const std::string file = std::filesystem::path(where.file).filename().string();
  const int shape = push("trianglemesh at " + file + ":" + std::to_string(where.line), where, std::move(mesh));
  repair(scene_.shapes.back());
  return shape;
}

int ShapeTable::add_ply(const ParamList& params, bool turned) {
  const std::string file = params.get_string("filename", "");
  if (file.empty()) params.fail("\"string filename\" is missing");
  params.refuse("displacement", "is not known yet; displace the mesh");
  params.ignore("displacement.edgelength");
  params.ignore("edgelength");
  if (file.ends_with(".gz")) params.fail(*params.find("filename"), "is compressed; unpack it with gunzip");
  const std::string path =
      std::filesystem::path(folder_.path_of(file, params.find("filename")->where)).lexically_normal().string();
  const auto [known, is_new] = shapes_of_files_.try_emplace({path, turned});
  if (is_new) {
    known->second = push(file, params.where(), TriangleMesh());
    files_.push_back({known->second, path, params.find("filename")->where, turned});
  }
  return known->second;
}

int ShapeTable::add(const std::string& type, const ParamList& params, bool turned) {
  int shape = -1;
  if (type == "sphere") {
    shape = add_sphere(params);
  } else if (type == "trianglemesh") {
    shape = add_inline_mesh(params, turned);
  } else if (type == "plymesh") {
    shape = add_ply(params, turned);
  } else {
    params.fail("the shape '" + type + "' is not known yet; use trianglemesh, plymesh or sphere");
  }
  params.warn_unused(diagnostics_);
  return shape;
}

}  // namespace bdpt_tool
