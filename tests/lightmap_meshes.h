// Meshes with lightmap coordinates, by the C ABI alone.
#pragma once

#include "api_scene.h"

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace bdpt_api {

struct LightmapMesh {
  std::vector<std::array<float, 3>> positions, normals;
  std::vector<std::array<float, 2>> uv;
  std::vector<std::array<uint32_t, 3>> triangles;

  bdpt_mesh_desc desc() const {
    bdpt_mesh_desc d = make<bdpt_mesh_desc>();
    d.positions = view(positions.data(), positions.size(), BDPT_FORMAT_FLOAT3);
    d.indices = view(triangles.data(), triangles.size(), BDPT_FORMAT_UINT32X3);
    d.normals = view(normals.data(), normals.size(), BDPT_FORMAT_FLOAT3);
    d.uv[1] = view(uv.data(), uv.size(), BDPT_FORMAT_FLOAT2);
    return d;
  }
};

struct AtlasSide {
  float width, height;
  // Texel coordinates, rows down, as texture coordinates.
  std::array<float, 2> uv(float x, float y) const { return {x / width, 1 - y / height}; }
};

// A rectangle of texels [x0, x1] x [y0, y1] as a flat quad of scale times its size that lies in the plane z and begins
// at (left, 0); seen from z > 0 it shows the atlas as it is.
inline void add_quad(LightmapMesh& mesh, const AtlasSide& atlas, float x0, float y0, float x1, float y1, float scale,
                     float left = 0, float z = 0) {
  const auto first = uint32_t(mesh.positions.size());
  const float right = left + scale * (x1 - x0), up = scale * (y1 - y0);
  mesh.positions.insert(mesh.positions.end(), {{left, 0, z}, {right, 0, z}, {right, up, z}, {left, up, z}});
  mesh.uv.insert(mesh.uv.end(), {atlas.uv(x0, y1), atlas.uv(x1, y1), atlas.uv(x1, y0), atlas.uv(x0, y0)});
  mesh.triangles.insert(mesh.triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
}

// A triangle with these corners in texels; in the world it lies at the same place, in the plane z.
inline void add_triangle(LightmapMesh& mesh, const AtlasSide& atlas, const std::array<std::array<float, 2>, 3>& corners,
                         float z = 0) {
  const auto first = uint32_t(mesh.positions.size());
  for (const auto& [x, y] : corners) {
    mesh.positions.push_back({x, -y, z});
    mesh.uv.push_back(atlas.uv(x, y));
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
}

inline bdpt_uv_instance uv_instance(const bdpt_mesh_desc& mesh) {
  bdpt_uv_instance instance{};
  instance.mesh = &mesh;
  return instance;
}

// Of an OBJ file: v, vt and f with three or more corners. Empty if there is no such file.
inline LightmapMesh read_obj(const std::string& path) {
  LightmapMesh mesh;
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 2>> uv;
  std::map<std::pair<int, int>, uint32_t> vertices;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      auto& p = positions.emplace_back();
      words >> p[0] >> p[1] >> p[2];
    } else if (kind == "vt") {
      auto& t = uv.emplace_back();
      words >> t[0] >> t[1];
    } else if (kind == "f") {
      std::vector<uint32_t> corners;
      for (std::string corner; words >> corner;) {
        int p = 0, t = 0;
        std::sscanf(corner.c_str(), "%d/%d", &p, &t);
        const auto [it, added] = vertices.emplace(std::pair(p, t), uint32_t(mesh.positions.size()));
        if (added) {
          mesh.positions.push_back(positions.at(size_t(p - 1)));
          mesh.uv.push_back(t > 0 ? uv.at(size_t(t - 1)) : std::array<float, 2>{});
        }
        corners.push_back(it->second);
      }
      for (size_t i = 2; i < corners.size(); ++i) mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }
  return mesh;
}

}  // namespace bdpt_api
