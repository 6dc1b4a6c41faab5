// Small scenes, built in code. A Builder collects shapes with their materials; build() makes the immutable scene.
#pragma once

#include "sampling/hash.h"
#include "scene/scene.h"
#include "sensor/camera.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace bdpt::scenes {

// One for all tests of a program.
inline std::shared_ptr<const RayDevice> device() {
  static const auto device = std::make_shared<const RayDevice>(Isa::Best, std::make_shared<MemoryMeter>(0));
  return device;
}

// --- Materials ---

inline Material diffuse(const Rgb& reflectance) {
  Material m;
  m.reflectance = reflectance;
  return m;
}
inline Material diffuse(float reflectance) { return diffuse(Rgb(reflectance)); }

inline Material emitter(const Rgb& radiance, bool two_sided = false, float reflectance = 0) {
  Material m = diffuse(reflectance);
  m.emission = radiance;
  m.emission_two_sided = two_sided;
  return m;
}

inline Material mirror(float reflectance = 1) {
  Material m = diffuse(reflectance);
  m.type = MaterialType::Mirror;
  return m;
}

inline Material conductor(float alpha_u, float alpha_v) {
  Material m;
  m.type = MaterialType::Conductor;
  m.eta = Rgb(0.14f, 0.38f, 1.44f);
  m.k = Rgb(3.98f, 2.40f, 1.60f);
  m.alpha_u = alpha_u, m.alpha_v = alpha_v;
  return m;
}

inline Material dielectric(float ior, float alpha = 0) {
  Material m;
  m.type = MaterialType::Dielectric;
  m.ior = ior;
  m.alpha_u = m.alpha_v = alpha;
  return m;
}

// --- Textures ---

// Floats, packed; row 0 is v = 1.
inline Texture texture(uint32_t width, uint32_t height, uint32_t channels, const std::vector<float>& texels,
                       uint32_t levels = 1) {
  TextureImage image;
  image.width = width, image.height = height, image.channels = channels;
  const auto* bytes = reinterpret_cast<const std::byte*>(texels.data());
  image.texels.assign(bytes, bytes + texels.size() * sizeof(float));
  return Texture(std::move(image), levels);
}

inline MaterialDesc textured(const MaterialDesc& material, Slot slot, int texture, uint8_t channel = 0) {
  MaterialDesc m = material;
  TextureUse use;
  use.slot = slot, use.texture = texture, use.channel = channel;
  m.textures.push_back(use);
  return m;
}

// --- Meshes ---

struct MeshData {
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> uv, lightmap_uv;
  std::vector<Rgba> colors;
  std::vector<Triangle> triangles;

  // Front where a, b, c, d turn counter-clockwise.
  void add_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto first = uint32_t(positions.size());
    for (const Vec3& p : {a, b, c, d}) positions.push_back(p);
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
};

inline MeshData quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  MeshData m;
  m.add_quad(a, b, c, d);
  return m;
}

// A mesh of quads, each with a square of its own in the lightmap, columns to a row, and a margin round it.
inline MeshData unwrapped(MeshData m, int columns, float margin) {
  const size_t quads = m.positions.size() / 4;
  const float side = 1 / float(columns);
  for (size_t i = 0; i < quads; ++i) {
    const Vec2 low(float(i % size_t(columns)) * side + margin, float(i / size_t(columns)) * side + margin);
    const float size = side - 2 * margin;
    for (const Vec2& corner : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)})
      m.lightmap_uv.push_back(low + corner * size);
  }
  return m;
}

// The six sides of a box, bit i of `sides`: -x, +x, -y, +y, -z, +z; fronts look inward if `inward`.
inline MeshData box(const Vec3& low, const Vec3& high, bool inward, unsigned sides = 63) {
  MeshData m;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      if (!(sides >> (2 * axis + side) & 1)) continue;
      Vec3 corner[4];
      for (int i = 0; i < 4; ++i) {
        corner[i][axis] = (side ? high : low)[axis];
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        corner[i][u] = (i == 1 || i == 2 ? high : low)[u];  // counter-clockwise seen from +axis
        corner[i][v] = (i >= 2 ? high : low)[v];
      }
      if ((side == 1) != inward)
        m.add_quad(corner[0], corner[1], corner[2], corner[3]);
      else
        m.add_quad(corner[0], corner[3], corner[2], corner[1]);
    }
  return m;
}

// A fan of n triangles of the area of a disk round center, its front toward the unit vector n.
inline MeshData disk(const Vec3& center, const Vec3& n, float radius, int count) {
  MeshData m;
  const Frame frame(n);
  const double sector = 2 * M_PI / count, reach = radius * std::sqrt(sector / std::sin(sector));
  m.positions.push_back(center);
  for (int i = 0; i < count; ++i)
    m.positions.push_back(center + (frame.t * float(std::cos(i * sector)) + frame.b * float(std::sin(i * sector))) *
                                       float(reach));
  for (int i = 0; i < count; ++i) m.triangles.push_back({0, uint32_t(i + 1), uint32_t((i + 1) % count + 1)});
  return m;
}

// A tessellated sphere; with normals of the sphere itself where smooth.
inline MeshData ball(const Vec3& center, float radius, int rows, bool smooth) {
  MeshData m;
  const int columns = 2 * rows;
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double theta = M_PI * i / rows, phi = 2 * M_PI * j / columns;
      const Vec3 n(float(std::sin(theta) * std::cos(phi)), float(std::cos(theta)),
                   float(std::sin(theta) * std::sin(phi)));
      m.positions.push_back(center + n * radius);
      if (smooth) m.normals.push_back(n);
    }
  const auto at = [&](int i, int j) { return uint32_t(i * columns + j % columns); };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      if (i > 0) m.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      if (i + 1 < rows) m.triangles.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
  return m;
}

inline std::shared_ptr<const Mesh> make_mesh(const MeshData& data) {
  const auto own = std::make_shared<MeshData>(data);
  auto mesh = std::make_shared<Mesh>();
  own->positions.resize(data.positions.size() + 2);  // padded, as Embree reads 16 bytes past the last
  mesh->positions = View<Vec3>(own->positions.data(), data.positions.size(), sizeof(Vec3));
  mesh->positions_padded = true;
  mesh->triangles = View<Triangle>(own->triangles.data(), own->triangles.size(), sizeof(Triangle));
  mesh->normals = View<Vec3>(own->normals.data(), own->normals.size(), sizeof(Vec3));
  mesh->uv[0] = View<Vec2>(own->uv.data(), own->uv.size(), sizeof(Vec2));
  mesh->uv[1] = View<Vec2>(own->lightmap_uv.data(), own->lightmap_uv.size(), sizeof(Vec2));
  mesh->colors = View<Rgba>(own->colors.data(), own->colors.size(), sizeof(Rgba));
  mesh->content_hash = hash_bytes(own->positions.data(), data.positions.size() * sizeof(Vec3));
  mesh->content_hash = hash_bytes(own->lightmap_uv.data(), own->lightmap_uv.size() * sizeof(Vec2), mesh->content_hash);
  mesh->keepers.push_back(own);
  return mesh;
}

// --- Lights ---

inline std::shared_ptr<const Texture> picture(uint32_t width, uint32_t height,
                                              const std::function<Rgb(uint32_t x, uint32_t y)>& texel) {
  std::vector<float> texels;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      const Rgb c = texel(x, y);
      texels.insert(texels.end(), {c.r, c.g, c.b});
    }
  return std::make_shared<const Texture>(texture(width, height, 3, texels));
}

// A sky of some clouds and a bright spot, above a black ground; turned so that the spot is overhead.
inline LightDesc environment_map(float scale = 1) {
  LightDesc l;
  l.type = LightType::Environment;
  l.radiance = Rgb(scale, scale, 1.5f * scale);
  l.texture = picture(16, 8, [](uint32_t x, uint32_t y) {
    if (x == 5 && y == 3) return Rgb(40, 30, 20);
    return y >= 4 ? Rgb() : Rgb(float((x * 7 + y * 3) % 5), 1, float(y));
  });
  const float s = std::sqrt(0.5f);
  const float turn[] = {0.6f, 0.8f, 0, 0, -0.8f * s, 0.6f * s, s, 0, 0.8f * s, -0.6f * s, s, 0};
  std::copy(turn, turn + 12, l.transform.m);
  return l;
}

// Through the hole of the room's ceiling.
inline LightDesc directional(double degrees, const Rgb& irradiance = Rgb(3, 4, 5)) {
  LightDesc l;
  l.type = LightType::Directional;
  l.direction = unit(Vec3(0.2f, -1, -0.5f));
  l.irradiance = irradiance;
  l.angular_radius = degrees * M_PI / 180;
  return l;
}

// The hole of the room's ceiling, and more or less of it; or raised by so much.
inline Portal skylight(float raised = 0, float part = 1) {
  return {Vec3(-1, 1 + raised, 0.4f), Vec3(2 * part, 0, 0), Vec3(0, 0.3f * raised, 0.6f)};
}

// --- Scenes ---

class Builder {
 public:
  explicit Builder(float scale = 1) : scale_(scale) {}

  Builder& add(MeshData data, const MaterialDesc& material, const Transform& transform = {}) {
    for (Vec3& p : data.positions) p *= scale_;
    return add({make_mesh(data), nullptr}, material, transform);
  }
  Builder& add_sphere(const Vec3& center, float radius, const MaterialDesc& material) {
    Sphere sphere;
    sphere.center = center * scale_;
    sphere.radius = radius * scale_;
    return add({nullptr, std::make_shared<const Sphere>(sphere)}, material, {});
  }
  Builder& add(const Shape& shape, const MaterialDesc& material, const Transform& transform) {
    desc_.shapes.push_back(shape);
    desc_.materials.push_back(material);
    return add_instance(int(desc_.shapes.size()) - 1, int(desc_.materials.size()) - 1, transform);
  }
  // The number that the next shape and its material get.
  int next_shape() const { return int(desc_.shapes.size()); }
  Builder& add_instance(int shape, int material, const Transform& transform) {
    InstanceDesc instance;
    instance.shape = shape;
    instance.material = material;
    instance.transform = transform;
    desc_.instances.push_back(instance);
    return *this;
  }
  // The instance added last goes on to there until the shutter closes.
  Builder& moving(const Transform& end) {
    desc_.instances.back().moves = true;
    desc_.instances.back().end = end;
    return *this;
  }
  // The instance added last.
  Builder& invisible() {
    desc_.instances.back().invisible = true;
    return *this;
  }
  int add_material(const MaterialDesc& material) {
    desc_.materials.push_back(material);
    return int(desc_.materials.size()) - 1;
  }
  int add_medium(std::shared_ptr<const Medium> medium) {
    desc_.media.push_back(std::move(medium));
    return int(desc_.media.size()) - 1;
  }
  Builder& outside(int medium) {
    desc_.outside = medium;
    return *this;
  }
  int add_texture(std::shared_ptr<const Texture> texture) {
    desc_.textures.push_back(std::move(texture));
    return int(desc_.textures.size()) - 1;
  }
  int add_texture(Texture texture) {
    desc_.textures.push_back(std::make_shared<const Texture>(std::move(texture)));
    return int(desc_.textures.size()) - 1;
  }
  Builder& point(const Vec3& position, const Rgb& intensity) {
    LightDesc l;
    l.position = position * scale_;
    l.intensity = intensity * (scale_ * scale_);
    desc_.lights.push_back(l);
    return *this;
  }
  Builder& spot(const Vec3& position, const Vec3& direction, const Rgb& intensity, double outer, double inner) {
    point(position, intensity);
    LightDesc& l = desc_.lights.back();
    l.type = LightType::Spot;
    l.direction = unit(direction);
    l.cos_outer = float(std::cos(outer * M_PI / 180));
    l.cos_inner = float(std::cos(inner * M_PI / 180));
    return *this;
  }
  Builder& environment(const Rgb& radiance, uint32_t group = 0) {
    LightDesc l;
    l.type = LightType::Environment;
    l.group = group;
    l.radiance = radiance;
    return light(l);
  }
  Builder& light(const LightDesc& l) {
    desc_.lights.push_back(l);
    return *this;
  }
  std::shared_ptr<const Scene> build() const {
    return std::make_shared<const Scene>(desc_, device(), std::make_shared<MemoryMeter>(0), nullptr);
  }

 private:
  float scale_;
  SceneDesc desc_;
};

// --- Cameras ---

struct Viewpoint {
  Vec3 from, to;
  float field_of_view = 60;
  float lens_radius = 0, focus = 1;
  int blades = 0;
  float rotation = 0;
};

inline CameraDesc camera_desc(const Viewpoint& view, int width, int height, float scale = 1) {
  CameraDesc d;
  d.width = width, d.height = height;
  d.crop[2] = width, d.crop[3] = height;
  d.field_of_view = view.field_of_view;
  d.lens_radius = view.lens_radius * scale;
  d.focus_distance = view.focus * scale;
  d.aperture_blades = view.blades;
  d.aperture_rotation = view.rotation;
  const Vec3 back = unit(view.from - view.to);
  const Vec3 right = unit(cross(std::fabs(back.y) > 0.9f ? Vec3(0, 0, -1) : Vec3(0, 1, 0), back));
  const Vec3 up = cross(back, right), from = view.from * scale;
  for (int row = 0; row < 3; ++row) {
    d.transform.m[4 * row] = right[row];
    d.transform.m[4 * row + 1] = up[row];
    d.transform.m[4 * row + 2] = back[row];
    d.transform.m[4 * row + 3] = from[row];
  }
  return d;
}

inline std::shared_ptr<const Camera> camera(const Viewpoint& view, int width, int height, float scale = 1) {
  return make_camera(camera_desc(view, width, height, scale));
}

// --- A room, 2 x 2 x 2 round the origin ---

enum class Contents { Diffuse, Glossy, Specular };

struct RoomOptions {
  Contents contents = Contents::Diffuse;
  bool points = false;       // a point and a spot light, out of the pictures
  bool environment = false;  // through a hole in the ceiling, which no camera inside sees
  float scale = 1;
  bool lantern = false;  // a mesh of many triangles that shines
  bool lamps = true;     // a square, a two-sided one and a sphere
  std::vector<LightDesc> lights = {};

  bool has_hole() const {
    return environment || std::any_of(lights.begin(), lights.end(), [](const auto& l) { return !l.has_position(); });
  }
};

inline MeshData lantern() { return ball(Vec3(-0.6f, 0.5f, -0.5f), 0.15f, 3, false); }

inline Builder room(const RoomOptions& options) {
  Builder b(options.scale);
  const Vec3 low(-1), high(1);
  b.add(box(low, high, true, 1), diffuse(Rgb(0.7f, 0.2f, 0.15f)));
  b.add(box(low, high, true, 2), diffuse(Rgb(0.2f, 0.6f, 0.2f)));
  b.add(box(low, high, true, 4 | 16 | 32), diffuse(0.6f));
  MeshData ceiling = quad(Vec3(-1, 1, -1), Vec3(1, 1, -1), Vec3(1, 1, 0.4f), Vec3(-1, 1, 0.4f));
  if (!options.has_hole()) ceiling.add_quad(Vec3(-1, 1, 0.4f), Vec3(1, 1, 0.4f), Vec3(1, 1, 1), Vec3(-1, 1, 1));
  b.add(ceiling, diffuse(0.6f));
  // One-sided under the ceiling, two-sided standing at a wall, and a sphere: all within sight.
  if (options.lamps) {
    b.add(quad(Vec3(-0.4f, 0.9f, -0.6f), Vec3(0.4f, 0.9f, -0.6f), Vec3(0.4f, 0.9f, 0.1f), Vec3(-0.4f, 0.9f, 0.1f)),
          emitter(Rgb(4, 3.5f, 3)));
    b.add(
        quad(Vec3(-0.8f, -0.2f, -0.9f), Vec3(-0.8f, -0.2f, -0.5f), Vec3(-0.5f, 0.4f, -0.5f), Vec3(-0.5f, 0.4f, -0.9f)),
        emitter(Rgb(1, 1.5f, 2), true, 0.4f));
    b.add_sphere(Vec3(0.65f, 0.35f, -0.5f), 0.15f, emitter(Rgb(3, 2, 1), false, 0.3f));
  }
  if (options.lantern) b.add(lantern(), emitter(Rgb(2, 2.5f, 3), false, 0.3f));
  const Vec3 left(-0.4f, -0.6f, -0.2f), right(0.4f, -0.65f, 0.1f), middle(0, -0.2f, -0.6f);
  switch (options.contents) {
    case Contents::Diffuse:
      b.add(ball(left, 0.4f, 4, true), diffuse(Rgb(0.8f, 0.8f, 0.5f)));
      b.add(ball(right, 0.35f, 3, true), diffuse(Rgb(0.4f, 0.5f, 0.8f)));
      b.add(box(middle - Vec3(0.2f), middle + Vec3(0.2f), false), diffuse(0.5f));
      break;
    case Contents::Glossy:
      b.add(ball(left, 0.4f, 5, true), conductor(0.35f, 0.35f));
      b.add_sphere(right, 0.35f, dielectric(1.5f, 0.4f));
      b.add(ball(middle, 0.25f, 5, true), conductor(0.3f, 0.6f));
      break;
    case Contents::Specular:
      b.add_sphere(left, 0.4f, dielectric(1.5f));
      b.add_sphere(right, 0.35f, mirror(0.9f));
      b.add(ball(middle, 0.25f, 4, true), conductor(0.4f, 0.4f));
      break;
  }
  if (options.points) {
    b.point(Vec3(0.7f, -0.2f, 0.5f), Rgb(0.3f, 0.3f, 0.4f));
    b.spot(Vec3(-0.6f, 0.7f, 0.5f), Vec3(0.5f, -1, -0.3f), Rgb(1.5f, 1, 1), 40, 25);
  }
  if (options.environment) b.environment(Rgb(1.5f, 1.5f, 2));
  for (const LightDesc& l : options.lights) b.light(l);
  return b;
}

inline Viewpoint room_view() { return {Vec3(0.1f, 0, 0.95f), Vec3(0, -0.15f, -0.5f), 75}; }
inline Viewpoint room_view_through_lens() {
  Viewpoint view = room_view();
  view.lens_radius = 0.1f;
  view.focus = 1.2f;
  return view;
}

}  // namespace bdpt::scenes
