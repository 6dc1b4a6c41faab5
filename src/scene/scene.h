// The immutable whole: instances of shapes with materials, lights, and the ray queries over them.
#pragma once

#include "base/memory.h"
#include "geometry/embree.h"
#include "geometry/margin.h"
#include "light/lights.h"
#include "material/material_store.h"
#include "math/box.h"
#include "scene/host_lookups.h"
#include "scene/interiors.h"
#include "scene/scene_desc.h"

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace bdpt {

// A point of a surface.
struct Surface {
  Vec3 p;
  float margin;  // see off_surface()
  Vec3 ng;       // geometric normal, unit, on the front
  Vec3 ns;       // shading normal, unit, in the hemisphere of ng
  Vec3 tangent;  // along u of uv set 0; set for anisotropic materials only
  Rgb reflectance;
  const Material* material = nullptr;  // the scene's, or by shade() a copy of its own
  int light = -1;                      // index of the area light this instance is, or -1
  uint32_t primitive = 0;              // triangle of the mesh, or segment of the curves
};

struct SceneInfo {
  uint64_t instances = 0, triangles = 0, spheres = 0, curves = 0, degenerate = 0;
  uint64_t memory = 0, memory_embree = 0, hash = 0;
  Vec3 bounds_min, bounds_max;
  bool has_specular = false;  // some material, somewhere
};

class Scene {
 public:
  // Called now and then with the fraction done; false stops the build, which then throws RayScene::Cancelled.
  using Progress = std::function<bool(double)>;

  // Throws Error(InvalidArgument) for a scene with neither instance nor light.
  Scene(SceneDesc desc, const std::shared_ptr<const RayDevice>& device, const std::shared_ptr<MemoryMeter>& meter,
        const Progress& progress);

  const RayScene& rays() const { return *rays_; }
  const Lights& lights() const { return lights_; }
  const SceneInfo& info() const { return info_; }

  // --- Media ---
  // Whether what encloses a point matters at all; else every Interior is empty.
  bool has_interiors() const { return has_interiors_; }
  // Whether there are surfaces that rays may have to pass: then shadow rays are not enough.
  bool has_passable() const { return has_passable_; }
  const Interiors& interiors() const { return interiors_; }
  // What encloses a point, by a ray that leaves it.
  Interior interior_at(const Vec3& p) const;
  Interior interior_of_light(int light) const {
    return light_interiors_.empty() ? Interior() : light_interiors_[size_t(light)];
  }
  // The other side of a surface, seen from its front or its back. False where four enclose the point already.
  static bool enter_or_leave(Interior& interior, uint16_t encloses, bool from_front) {
    if (encloses == 0) return true;
    if (from_front && interior.is_full()) return false;
    interior = from_front ? interior.entered(encloses) : interior.left(encloses);
    return true;
  }
  // Whether rays pass the surface as if it were not there.
  bool is_passed(const Material& material, const Interior& interior, bool from_front) const {
    if (!has_passable_ || material.encloses == 0) return false;
    return material.type == MaterialType::Interface ||
           !interiors_.is_boundary(from_front ? interior : interior.left(material.encloses), material.encloses);
  }

  // --- For sensors on surfaces ---
  size_t instance_count() const { return instances_.size(); }
  uint64_t instance_id(uint32_t instance) const { return desc_.instances[instance].id; }
  uint64_t material_id(uint32_t instance) const { return desc_.instances[instance].material_id; }
  const std::string& instance_label(uint32_t instance) const { return desc_.instances[instance].label; }
  // Whether something moves: then rays have times.
  bool moves() const { return moves_; }
  bool moves(uint32_t instance) const { return instances_[instance].end != nullptr; }
  // Whether rays, and so light, meet it wherever it is.
  bool is_solid(uint32_t instance) const {
    return !desc_.instances[instance].invisible && instances_[instance].material->opacity.mode == Opacity::Mode::Opaque;
  }
  const Mesh* mesh(uint32_t instance) const { return instances_[instance].mesh; }  // nullptr for the others
  double triangle_area(uint32_t instance, uint32_t primitive) const;               // in the world
  // The geometry at a point of a mesh; false where it is too degenerate to have a normal.
  bool point(uint32_t instance, uint32_t primitive, float u, float v, Surface& surface) const {
    return triangle_surface(instances_[instance], primitive, u, v, surface);
  }

  // --- For lists of what emits ---
  const std::vector<LightDesc>& light_descs() const { return desc_.lights; }
  const Material& material(uint32_t instance) const { return *instances_[instance].material; }

  // The geometry at a hit of a ray; false where it is too degenerate to have a normal.
  bool surface(const Ray& ray, const Hit& hit, Surface& surface) const;
  // What textures and colours make of it: reflectance, shading normal, tangent, and the material's numbers. answers:
  // of the host's textures, if there are any.
  void shade(const Hit& hit, Surface& surface, MaterialStore& store, const Rgba* answers = nullptr) const;
  // Those of the host's are asked before, for many hits at once.
  bool has_host_textures() const { return !desc_.host_textures.empty(); }
  const HostLookups::Textures& host_textures() const { return desc_.host_textures; }
  void gather(const Ray& ray, const Hit& hit, HostLookups& lookups) const;

 private:
  struct Instance {
    const Mesh* mesh = nullptr;
    const Sphere* sphere = nullptr;
    const Curves* curves = nullptr;  // transform is from their unit
    const MaterialDesc* material = nullptr;
    bool is_plain = true;  // there is nothing to shade
    bool varies = false;   // its material's numbers are those of the place
    bool asks_host = false;
    Transform transform, inverse;
    const Transform* end = nullptr;  // at time 1, of what moves
    View<Vec3> world_positions;      // empty where the mesh is instanced
    float handedness = 1;            // -1 where the transform reflects: keeps the front the image of the front
    bool identity = false;
    int light = -1;
    Vec3 center{0, 0, 0};  // sphere, in the world
    float radius = 0;

    void place(const Transform& to_world);
    // Where it is then.
    Instance at(float time) const;
  };
  bool surface_of(const Instance& instance, const Ray& ray, const Hit& hit, Surface& surface) const;
  void shade_as(const Instance& instance, const Hit& hit, Surface& surface, MaterialStore& store,
                const Rgba* answers) const;
  void gather_as(const Instance& instance, const Ray& ray, const Hit& hit, HostLookups& lookups) const;
  void gather(const MaterialDesc& material, const Instance& instance, const Hit& hit, const Surface& surface,
              HostLookups& lookups) const;
  void number_answers();
  bool asks_host(const MaterialDesc& material) const;

  View<Vec3> object_positions(const Mesh& mesh);
  const OpacityTest* opacity_test(const Instance& instance);
  std::vector<int> uses_of_shapes() const;
  uint64_t world_position_bytes() const;
  void number_enclosures();
  void find_light_interiors();
  void place_instances();
  void collect_lights();
  Box bounds() const;
  void check_emitter(size_t instance) const;  // that it can
  Lights::AreaLight area_light(size_t instance) const;
  bool triangle_surface(const Instance& instance, uint32_t primitive, float u, float v, Surface& surface) const;
  bool curve_surface(const Instance& instance, const Ray& ray, const Hit& hit, Surface& surface) const;
  void check_curves(const InstanceDesc& desc) const;
  // Texture coordinates of a set at a hit, and how the point moves with them; false where they do not vary.
  struct UvFrame {
    Vec2 uv;
    Vec3 dp_du, dp_dv;
  };
  Vec2 uv_at(const Instance& instance, int set, const Hit& hit, const Vec3& ng) const;
  bool uv_frame(const Instance& instance, int set, const Hit& hit, const Vec3& ng, UvFrame& frame) const;
  bool varies(const MaterialDesc& material) const;
  // With the derivatives by the texture's own coordinates; false where they do not vary.
  bool uv_frame(const Instance& instance, const TextureUse& use, const Hit& hit, const Vec3& ng, UvFrame& frame) const;
  Vec2 step_of(const TextureUse& use) const;
  void vary(const MaterialDesc& material, const Instance& instance, const Hit& hit, const Vec3& ng, const Rgba* answers,
            Rgb& reflectance, Material* own) const;
  const Material* part(const MaterialDesc& mix, int index, const Instance& instance, const Hit& hit, const Vec3& ng,
                       const Rgba* answers, MaterialStore& store) const;
  void bend_normal(const Instance& instance, const TextureUse& use, const Hit& hit, const Rgba* answers,
                   Surface& surface) const;

  SceneDesc desc_;
  std::vector<Instance> instances_;
  std::vector<std::vector<Vec3>> world_positions_;          // what the views below point into
  std::vector<std::pair<const Mesh*, View<Vec3>>> padded_;  // meshes whose positions had to be copied
  std::vector<std::unique_ptr<const OpacityTest>> opacity_tests_;
  Lights lights_;
  Interiors interiors_;
  bool has_interiors_ = false, has_passable_ = false, moves_ = false;
  std::vector<Interior> light_interiors_;
  std::unique_ptr<RayScene> rays_;
  SceneInfo info_;
  Booking booking_, light_booking_;
};

}  // namespace bdpt
