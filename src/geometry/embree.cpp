#include "geometry/embree.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "sampling/hash.h"

#include <dlfcn.h>

#include <limits>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace bdpt {

namespace {

// Lanes of a packet that hold a ray; Embree wants -1 for those that do.
void set_valid(int* valid, size_t lanes) {
  for (size_t i = 0; i < 16; ++i) valid[i] = i < lanes ? -1 : 0;
}

#if RTC_VERSION_MAJOR >= 4
void intersect16(const int* valid, RTCScene scene, RTCRayHit16* rays) { rtcIntersect16(valid, scene, rays); }
void occluded16(const int* valid, RTCScene scene, RTCRay16* rays) { rtcOccluded16(valid, scene, rays); }
#else
void intersect16(const int* valid, RTCScene scene, RTCRayHit16* rays) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect16(valid, scene, &context, rays);
}
void occluded16(const int* valid, RTCScene scene, RTCRay16* rays) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded16(valid, scene, &context, rays);
}
#endif

// By which surfaces that are there in part decide: of the ray as it was asked for, whatever Embree makes of it.
uint32_t ray_number(const Ray& ray) {
  const float numbers[] = {ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z};
  return uint32_t(hash_bytes(numbers, sizeof numbers) >> 32);
}

void load(RTCRay16& packet, const Ray* rays, size_t lanes, bool numbered) {
  for (size_t i = 0; i < lanes; ++i) {
    packet.org_x[i] = rays[i].origin.x;
    packet.org_y[i] = rays[i].origin.y;
    packet.org_z[i] = rays[i].origin.z;
    packet.dir_x[i] = rays[i].direction.x;
    packet.dir_y[i] = rays[i].direction.y;
    packet.dir_z[i] = rays[i].direction.z;
    packet.tfar[i] = rays[i].tmax;
    packet.id[i] = numbered ? ray_number(rays[i]) : 0;
    packet.time[i] = rays[i].time;
  }
  for (size_t i = 0; i < 16; ++i) {
    packet.tnear[i] = 0;
    packet.mask[i] = ~0u;
    packet.flags[i] = 0;
  }
  // Where Embree has no packets of 16 it goes by whether tnear <= tfar, not by what is said to be valid.
  for (size_t i = lanes; i < 16; ++i) {
    packet.org_x[i] = packet.org_y[i] = packet.org_z[i] = 0;
    packet.dir_x[i] = packet.dir_y[i] = packet.dir_z[i] = 1;
    packet.tfar[i] = -std::numeric_limits<float>::infinity();
    packet.id[i] = 0;
    packet.time[i] = 0;
  }
}

const char* isa_config(Isa isa) {
  switch (isa) {
    case Isa::Sse42:
      return "isa=sse4.2";
    case Isa::Avx2:
      return "isa=avx2";
    case Isa::Avx512:
      return "isa=avx512";
    case Isa::Best:
    case Isa::Neon:
      break;
  }
  return nullptr;
}

// --- Which Embree answers. Its functions have names without a version: where the program, or what it loaded before
// this library, has another Embree, the loader gives us that one's. Only what is the same in all versions is called
// before this is known. ---

// All that is called, here and in limit_surface.cpp.
const void* const kFunctions[] = {
    (const void*)rtcNewDevice,
    (const void*)rtcGetDeviceProperty,
    (const void*)rtcGetDeviceError,
    (const void*)rtcReleaseDevice,
    (const void*)rtcSetDeviceMemoryMonitorFunction,
    (const void*)rtcNewScene,
    (const void*)rtcReleaseScene,
    (const void*)rtcCommitScene,
    (const void*)rtcSetSceneFlags,
    (const void*)rtcSetSceneBuildQuality,
    (const void*)rtcSetSceneProgressMonitorFunction,
    (const void*)rtcNewGeometry,
    (const void*)rtcReleaseGeometry,
    (const void*)rtcCommitGeometry,
    (const void*)rtcAttachGeometry,
    (const void*)rtcAttachGeometryByID,
    (const void*)rtcSetGeometryInstancedScene,
    (const void*)rtcSetGeometryIntersectFilterFunction,
    (const void*)rtcSetGeometryOccludedFilterFunction,
    (const void*)rtcSetGeometrySubdivisionMode,
    (const void*)rtcSetGeometryTimeStepCount,
    (const void*)rtcSetGeometryTransform,
    (const void*)rtcSetGeometryUserData,
    (const void*)rtcSetNewGeometryBuffer,
    (const void*)rtcSetSharedGeometryBuffer,
    (const void*)rtcInterpolateN,
    (const void*)rtcIntersect16,
    (const void*)rtcOccluded16,
};

constexpr const char* kOtherEmbree =
    ". The program, or a library that it loads, brings an Embree of its own: see docs/embedding.md, \"Another Embree\"";

std::string file_of(const void* function) {
  Dl_info info{};
  return dladdr(function, &info) && info.dli_fname ? info.dli_fname : "a file unknown";
}

// Once: what a name is bound to when this library is loaded (-z now) it stays bound to.
void check_one_embree() {
  static const std::string other = [] {
    for (const void* function : kFunctions)
      if (const std::string file = file_of(function); file != file_of(kFunctions[0])) return file;
    return std::string();
  }();
  if (!other.empty())
    fail(ErrorCode::Unsupported, "Embree's functions come from two files, ", file_of(kFunctions[0]), " and ", other,
         kOtherEmbree);
}

std::string version_text(uint32_t version) {
  return std::to_string(version / 10000) + '.' + std::to_string(version / 100 % 100) + '.' +
         std::to_string(version % 100);
}

constexpr uint32_t kBuiltFor = RTC_VERSION_MAJOR * 10000 + RTC_VERSION_MINOR * 100 + RTC_VERSION_PATCH;

uint32_t checked_version(RTCDevice device) {
  const auto get = [&](RTCDeviceProperty property) { return rtcGetDeviceProperty(device, property); };
  const uint32_t version = uint32_t(get(RTC_DEVICE_PROPERTY_VERSION));
  if (version / 10000 != RTC_VERSION_MAJOR || version / 100 < kBuiltFor / 100)
    fail(ErrorCode::Unsupported, "this library was built for Embree ", version_text(kBuiltFor), ", but Embree ",
         version_text(version), " answers, from ", file_of(kFunctions[0]), kOtherEmbree);
  // Options of Embree's build without which pictures would be wrong, and nobody be told.
  const bool complete =
      get(RTC_DEVICE_PROPERTY_FILTER_FUNCTION_SUPPORTED) && get(RTC_DEVICE_PROPERTY_TRIANGLE_GEOMETRY_SUPPORTED) &&
      get(RTC_DEVICE_PROPERTY_SUBDIVISION_GEOMETRY_SUPPORTED) && get(RTC_DEVICE_PROPERTY_CURVE_GEOMETRY_SUPPORTED) &&
      get(RTC_DEVICE_PROPERTY_POINT_GEOMETRY_SUPPORTED) && !get(RTC_DEVICE_PROPERTY_BACKFACE_CULLING_ENABLED);
  if (!complete)
    fail(ErrorCode::Unsupported, "Embree ", version_text(version), " from ", file_of(kFunctions[0]),
         " was built without filter functions, triangles, subdivision surfaces, curves or points, or culls back faces: "
         "this library needs one with all of them, and without culling");
  return version;
}

}  // namespace

struct RayDevice::Implementation {
  RTCDevice device = nullptr;
  uint32_t version = 0;
  Isa isa = Isa::Best;
  std::shared_ptr<MemoryMeter> meter;
  std::atomic<int64_t> bytes{0};
  std::atomic<bool> over_limit{false};

  // Embree tells of each allocation beforehand; refusing one makes it report out of memory.
  static bool on_memory(void* self, ssize_t bytes, bool post) {
    auto& i = *static_cast<Implementation*>(self);
    if (bytes > 0 && !i.meter->try_add(uint64_t(bytes))) {
      i.over_limit = true;
      if (!post) return false;
      i.meter->add_always(uint64_t(bytes));  // it is allocated already
    }
    if (bytes < 0) i.meter->subtract(uint64_t(-bytes));
    i.bytes += bytes;
    return true;
  }
};

RayDevice::RayDevice(Isa isa, std::shared_ptr<MemoryMeter> meter)
    : implementation_(std::make_unique<Implementation>()) {
  auto& i = *implementation_;
  if (!is_available(isa))
    fail(ErrorCode::Unsupported, "isa: this machine does not have it; BDPT_ISA_BEST takes what it has");
  i.isa = isa == Isa::Best ? best_isa() : isa;
  i.meter = std::move(meter);
  check_one_embree();
  i.device = rtcNewDevice(isa_config(isa));
  if (!i.device) {
    const RTCError error = rtcGetDeviceError(nullptr);
    if (error == RTC_ERROR_OUT_OF_MEMORY) fail(ErrorCode::OutOfMemory, "Embree is out of memory");
    fail(ErrorCode::Unsupported, "Embree, from ", file_of(kFunctions[0]), ", cannot run on this machine (error ",
         int(error), ")");
  }
  try {
    i.version = checked_version(i.device);
  } catch (...) {
    rtcReleaseDevice(i.device);
    throw;
  }
  rtcSetDeviceMemoryMonitorFunction(i.device, Implementation::on_memory, &i);
}

RayDevice::~RayDevice() {
  rtcSetDeviceMemoryMonitorFunction(implementation_->device, nullptr, nullptr);
  rtcReleaseDevice(implementation_->device);
  if (implementation_->bytes > 0) implementation_->meter->subtract(uint64_t(implementation_->bytes.load()));
}

Isa RayDevice::isa() const { return implementation_->isa; }
uint32_t RayDevice::version() { return kBuiltFor; }
uint32_t RayDevice::running_version() const { return implementation_->version; }
RTCDeviceTy* RayDevice::embree() const { return implementation_->device; }

void RayDevice::check_refused(int error) const {
  auto& d = *implementation_;
  if (d.over_limit.exchange(false))
    fail(ErrorCode::MemoryLimit, "Embree's structures would exceed the context's memory_limit of ", d.meter->limit(),
         " bytes");
  if (error == RTC_ERROR_OUT_OF_MEMORY) fail(ErrorCode::OutOfMemory, "Embree is out of memory");
}

uint64_t RayDevice::memory() const { return uint64_t(std::max<int64_t>(0, implementation_->bytes.load())); }

struct RayScene::Implementation {
  std::shared_ptr<const RayDevice> device;
  RTCScene scene = nullptr;
  std::vector<RTCScene> instanced;          // one for each mesh or curves that instances share
  std::vector<const OpacityTest*> opacity;  // by instance; empty where all are there everywhere
  bool numbers_rays = false;                // something is there in part
  const std::function<bool(double)>* progress = nullptr;
  bool cancelled = false;

  ~Implementation() {
    if (scene) rtcReleaseScene(scene);
    for (RTCScene s : instanced) rtcReleaseScene(s);
  }

  RTCDevice handle() const { return device->implementation().device; }

  static bool on_progress(void* self, double n) {
    auto& i = *static_cast<Implementation*>(self);
    if (i.progress && *i.progress && !(*i.progress)(n)) i.cancelled = true;
    return !i.cancelled;
  }

  // What Embree refused to make: at the host's limit, or without memory.
  [[noreturn]] void fail_refused(RTCError error) {
    device->check_refused(error);
    fail(ErrorCode::Internal, "Embree reports error ", int(error), " while building");
  }

  RTCGeometry new_geometry(RTCGeometryType type) {
    RTCGeometry g = rtcNewGeometry(handle(), type);
    if (!g) fail_refused(rtcGetDeviceError(handle()));
    return g;
  }

  RTCScene new_scene() {
    RTCScene s = rtcNewScene(handle());
    if (!s) fail_refused(rtcGetDeviceError(handle()));
    rtcSetSceneFlags(s, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(s, RTC_BUILD_QUALITY_MEDIUM);  // the HIGH builder is not known to be deterministic
    return s;
  }

  void commit(RTCScene s) {
    rtcCommitScene(s);
    if (cancelled) {
      rtcGetDeviceError(handle());
      throw Cancelled();
    }
    const RTCError error = rtcGetDeviceError(handle());
    if (device->implementation().over_limit || error != RTC_ERROR_NONE) fail_refused(error);
  }

  // Embree asks of each hit whether it counts.
  static void filter(const RTCFilterFunctionNArguments* arguments) {
    const auto& i = *static_cast<const Implementation*>(arguments->geometryUserPtr);
    const unsigned n = arguments->N;
    for (unsigned k = 0; k < n; ++k) {
      if (arguments->valid[k] == 0) continue;
      const unsigned outer = RTCHitN_instID(arguments->hit, n, k, 0);
      const unsigned instance = outer != RTC_INVALID_GEOMETRY_ID ? outer : RTCHitN_geomID(arguments->hit, n, k);
      const OpacityTest* test = i.opacity[instance];
      if (!test) continue;
      const unsigned primitive = RTCHitN_primID(arguments->hit, n, k);
      const float chance = float(hash_values(RTCRayN_id(arguments->ray, n, k), instance, primitive) >> 40) * 0x1p-24f;
      const Vec3 ng(RTCHitN_Ng_x(arguments->hit, n, k), RTCHitN_Ng_y(arguments->hit, n, k),
                    RTCHitN_Ng_z(arguments->hit, n, k));
      if (!test->is_there(primitive, RTCHitN_u(arguments->hit, n, k), RTCHitN_v(arguments->hit, n, k), ng,
                          RTCRayN_time(arguments->ray, n, k), chance))
        arguments->valid[k] = 0;
    }
  }

  // What instances share is asked for as soon as one of them is not there everywhere.
  void ask(RTCGeometry g) {
    rtcSetGeometryUserData(g, this);
    rtcSetGeometryIntersectFilterFunction(g, filter);
    rtcSetGeometryOccludedFilterFunction(g, filter);
  }

  RTCGeometry triangles(const View<Vec3>& positions, const View<Triangle>& indices) {
    RTCGeometry g = new_geometry(RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0, positions.stride(),
                               positions.size());
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(), 0, indices.stride(),
                               indices.size());
    return g;
  }

  RTCGeometry round_curves(const Curves& c) {
    constexpr RTCGeometryType kTypes[] = {RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE, RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE,
                                          RTC_GEOMETRY_TYPE_ROUND_BSPLINE_CURVE,
                                          RTC_GEOMETRY_TYPE_ROUND_CATMULL_ROM_CURVE};
    RTCGeometry g = new_geometry(kTypes[int(c.basis)]);
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, c.points.data(), 0,
                               sizeof(ControlPoint), c.points.size());
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, c.segments.data(), 0, sizeof(CurveSegment),
                               c.segments.size());
    return g;
  }

  RTCGeometry sphere(const Sphere& s, const Transform& transform, const Transform* end) {
    RTCGeometry g = new_geometry(RTC_GEOMETRY_TYPE_SPHERE_POINT);
    if (end) rtcSetGeometryTimeStepCount(g, 2);
    for (unsigned step = 0; step < (end ? 2u : 1u); ++step) {
      auto* v = static_cast<float*>(
          rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
      if (!v) {
        rtcReleaseGeometry(g);
        fail_refused(rtcGetDeviceError(handle()));
      }
      const Transform& t = step == 0 ? transform : *end;
      const Vec3 c = t.point(s.center);
      v[0] = c.x, v[1] = c.y, v[2] = c.z, v[3] = s.radius * length(t.column(0));
    }
    return g;
  }

  RTCGeometry instance(RTCScene of, const Transform& transform, const Transform* end) {
    RTCGeometry g = new_geometry(RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(g, of);
    rtcSetGeometryTimeStepCount(g, end ? 2 : 1);
    rtcSetGeometryTransform(g, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, transform.m);
    if (end) rtcSetGeometryTransform(g, 1, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, end->m);
    return g;
  }

  void attach(RTCGeometry g, uint32_t id, const OpacityTest* opacity = nullptr) {
    if (opacity) ask(g);
    rtcCommitGeometry(g);
    rtcAttachGeometryByID(scene, g, id);
    rtcReleaseGeometry(g);
  }
};

RayScene::RayScene(std::shared_ptr<const RayDevice> device, const std::vector<RayGeometry>& geometries,
                   const std::function<bool(double)>& progress)
    : implementation_(std::make_unique<Implementation>()) {
  auto& i = *implementation_;
  i.device = std::move(device);
  i.progress = &progress;
  i.scene = i.new_scene();
  if (std::any_of(geometries.begin(), geometries.end(), [](const RayGeometry& g) { return g.opacity; }))
    for (const RayGeometry& g : geometries) {
      i.opacity.push_back(g.opacity);
      i.numbers_rays = i.numbers_rays || (g.opacity && g.opacity->opacity.mode == Opacity::Mode::Blend);
    }
  const auto shape_of = [](const RayGeometry& g) { return g.mesh ? static_cast<const void*>(g.mesh) : g.curves; };
  std::unordered_set<const void*> asked;
  for (const RayGeometry& g : geometries)
    if (g.opacity) asked.insert(shape_of(g));
  std::unordered_map<const void*, RTCScene> shared;
  for (uint32_t id = 0; id < geometries.size(); ++id) {
    const RayGeometry& g = geometries[id];
    if (g.sphere) {
      i.attach(i.sphere(*g.sphere, g.transform, g.end), id, g.opacity);
    } else if (!g.mesh && !g.curves) {
      continue;
    } else if (g.mesh && !g.instanced) {
      i.attach(i.triangles(g.world_positions, g.mesh->triangles), id, g.opacity);
    } else {
      RTCScene& s = shared[shape_of(g)];
      if (!s) {
        s = i.new_scene();
        i.instanced.push_back(s);
        RTCGeometry t = g.mesh ? i.triangles(g.world_positions, g.mesh->triangles) : i.round_curves(*g.curves);
        if (asked.count(shape_of(g))) i.ask(t);
        rtcCommitGeometry(t);
        rtcAttachGeometry(s, t);
        rtcReleaseGeometry(t);
        i.commit(s);
      }
      i.attach(i.instance(s, g.transform, g.end), id);
    }
  }
  rtcSetSceneProgressMonitorFunction(i.scene, Implementation::on_progress, &i);
  i.commit(i.scene);
  rtcSetSceneProgressMonitorFunction(i.scene, nullptr, nullptr);
  i.progress = nullptr;
}

RayScene::~RayScene() = default;

void RayScene::intersect(const Ray* rays, Hit* hits, size_t count) const {
  alignas(64) RTCRayHit16 packet;
  alignas(64) int valid[16];
  for (size_t first = 0; first < count; first += 16) {
    const size_t lanes = std::min<size_t>(16, count - first);
    set_valid(valid, lanes);
    load(packet.ray, rays + first, lanes, implementation_->numbers_rays);
    for (size_t k = 0; k < 16; ++k) packet.hit.geomID[k] = packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    intersect16(valid, implementation_->scene, &packet);
    for (size_t k = 0; k < lanes; ++k) {
      const uint32_t instance = packet.hit.instID[0][k];
      Hit& hit = hits[first + k];
      hit.instance = instance != RTC_INVALID_GEOMETRY_ID ? instance : packet.hit.geomID[k];
      hit.primitive = packet.hit.primID[k];
      hit.u = packet.hit.u[k];
      hit.v = packet.hit.v[k];
      hit.t = packet.ray.tfar[k];
      hit.time = packet.ray.time[k];
    }
  }
}

void RayScene::occluded(const Ray* rays, uint8_t* blocked, size_t count) const {
  alignas(64) RTCRay16 packet;
  alignas(64) int valid[16];
  for (size_t first = 0; first < count; first += 16) {
    const size_t lanes = std::min<size_t>(16, count - first);
    set_valid(valid, lanes);
    load(packet, rays + first, lanes, implementation_->numbers_rays);
    occluded16(valid, implementation_->scene, &packet);
    for (size_t k = 0; k < lanes; ++k) blocked[first + k] = packet.tfar[k] < 0;
  }
}

}  // namespace bdpt
