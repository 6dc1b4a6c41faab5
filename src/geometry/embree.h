// The ray queries. This pair of files and limit_surface.* are the only ones that know Embree, and hide which of 3.13
// and 4 it is.
#pragma once

#include "base/isa.h"
#include "base/memory.h"
#include "geometry/curves.h"
#include "geometry/mesh.h"
#include "geometry/opacity.h"
#include "math/transform.h"

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

struct RTCDeviceTy;

namespace bdpt {

struct Ray {
  Vec3 origin;
  float tmax;
  Vec3 direction;  // need not be of unit length
  float time = 0;  // [0,1]: where what moves is
};

inline constexpr uint32_t kMiss = ~0u;

struct Hit {
  uint32_t instance = kMiss;  // index into the scene's instances
  uint32_t primitive = 0;     // triangle of the mesh, or segment of the curves
  float u = 0, v = 0;         // barycentric coordinates of the triangle's second and third vertex; u along the segment
  float t = 0;
  float time = 0;  // the ray's
};


// One of Embree's devices; books what Embree allocates.
class RayDevice {
 public:
  RayDevice(Isa isa, std::shared_ptr<MemoryMeter> meter);
  ~RayDevice();
  RayDevice(const RayDevice&) = delete;
  RayDevice& operator=(const RayDevice&) = delete;

  Isa isa() const;
  static uint32_t version();         // 10000 major + 100 minor + patch: that of the build
  uint32_t running_version() const;  // of the Embree that answers
  uint64_t memory() const;           // bytes Embree holds now

  RTCDeviceTy* embree() const;
  // Throws if it has refused memory, or if error (an RTCError) says that there is none.
  void check_refused(int error) const;

  struct Implementation;
  Implementation& implementation() const { return *implementation_; }

 private:
  std::unique_ptr<Implementation> implementation_;
};

// What one instance gives to the ray queries; none of the three: nothing.
struct RayGeometry {
  const Mesh* mesh = nullptr;      // or
  const Sphere* sphere = nullptr;  // or
  const Curves* curves = nullptr;  // always instanced
  Transform transform;             // object to world
  const Transform* end = nullptr;  // the same at time 1, of what moves
  // World positions, padded by 16 bytes, when the mesh is placed only once and is therefore not instanced.
  View<Vec3> world_positions;
  bool instanced = false;                // several instances of one mesh share one structure
  const OpacityTest* opacity = nullptr;  // nullptr: there everywhere
};

// The acceleration structure of a scene. Queries are thread-safe and pure: how rays are grouped changes no answer.
class RayScene {
 public:
  // progress(fraction) returns false to stop; then the constructor throws Cancelled.
  struct Cancelled {};
  RayScene(std::shared_ptr<const RayDevice> device, const std::vector<RayGeometry>& geometries,
           const std::function<bool(double)>& progress);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // The closest hit of each ray, in packets of 16.
  void intersect(const Ray* rays, Hit* hits, size_t count) const;
  // Whether anything lies on each ray in (0, tmax), in packets of 16.
  void occluded(const Ray* rays, uint8_t* blocked, size_t count) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bdpt
