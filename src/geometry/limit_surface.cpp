#include "geometry/limit_surface.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace bdpt {

struct LimitSurface::Implementation {
  RTCGeometry geometry = nullptr;
  const ControlCage* cage = nullptr;
  mutable std::vector<unsigned> faces;
  mutable std::vector<float> u, v, p, du, dv;

  ~Implementation() {
    if (geometry) rtcReleaseGeometry(geometry);
  }

  template <class T>
  void share(RTCBufferType type, RTCFormat format, const std::vector<T>& values, size_t stride = sizeof(T)) {
    if (!values.empty())
      rtcSetSharedGeometryBuffer(geometry, type, 0, format, values.data(), 0, stride,
                                 values.size() * sizeof(T) / stride);
  }

  // At `uv`, each moved toward the middle by a part of the way.
  void interpolate(uint32_t face, uint32_t quad, const std::vector<Vec2>& uv, float inward, bool derivatives) const {
    const size_t n = (uv.size() + 3) / 4 * 4;
    faces.assign(n, face);
    u.resize(n), v.resize(n), p.resize(3 * n), du.resize(3 * n), dv.resize(3 * n);
    const bool whole = cage->counts[face] == 4;
    for (size_t i = 0; i < n; ++i) {
      Vec2 at = uv[std::min(i, uv.size() - 1)];
      at += (Vec2(0.5f) - at) * inward;
      // Embree's numbers of the quads that a face of other than four corners is cut into.
      u[i] = whole ? at.x : float(2 * (quad % 4)) + at.x + 0.5f;
      v[i] = whole ? at.y : float(2 * (quad / 4)) + at.y + 0.5f;
    }
    RTCInterpolateNArguments a{};
    a.geometry = geometry;
    a.primIDs = faces.data();
    a.u = u.data(), a.v = v.data();
    a.N = unsigned(n);
    a.bufferType = RTC_BUFFER_TYPE_VERTEX;
    a.P = derivatives ? nullptr : p.data();
    if (derivatives) a.dPdu = du.data(), a.dPdv = dv.data();
    a.valueCount = 3;
    rtcInterpolateN(&a);
  }
};

LimitSurface::LimitSurface(const RayDevice& device, const ControlCage& cage)
    : implementation_(std::make_unique<Implementation>()) {
  auto& i = *implementation_;
  i.cage = &cage;
  i.geometry = rtcNewGeometry(device.embree(), RTC_GEOMETRY_TYPE_SUBDIVISION);
  if (!i.geometry) fail(ErrorCode::OutOfMemory, "Embree is out of memory");
  i.share(RTC_BUFFER_TYPE_FACE, RTC_FORMAT_UINT, cage.counts);
  i.share(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, cage.indices);
  rtcSetSharedGeometryBuffer(i.geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, cage.positions.data(), 0,
                             sizeof(Vec3), cage.position_count());
  i.share(RTC_BUFFER_TYPE_EDGE_CREASE_INDEX, RTC_FORMAT_UINT2, cage.crease_edges, 2 * sizeof(uint32_t));
  i.share(RTC_BUFFER_TYPE_EDGE_CREASE_WEIGHT, RTC_FORMAT_FLOAT, cage.crease_weights);
  i.share(RTC_BUFFER_TYPE_VERTEX_CREASE_INDEX, RTC_FORMAT_UINT, cage.corners);
  i.share(RTC_BUFFER_TYPE_VERTEX_CREASE_WEIGHT, RTC_FORMAT_FLOAT, cage.corner_weights);
  constexpr RTCSubdivisionMode kModes[] = {RTC_SUBDIVISION_MODE_SMOOTH_BOUNDARY, RTC_SUBDIVISION_MODE_PIN_CORNERS,
                                           RTC_SUBDIVISION_MODE_PIN_BOUNDARY};
  rtcSetGeometrySubdivisionMode(i.geometry, 0, kModes[int(cage.boundary)]);
  rtcCommitGeometry(i.geometry);
  const RTCError error = rtcGetDeviceError(device.embree());
  device.check_refused(error);
  if (error != RTC_ERROR_NONE)
    fail(ErrorCode::Internal, "Embree reports error ", int(error), " for a subdivision surface");
}

LimitSurface::~LimitSurface() = default;

void LimitSurface::evaluate(uint32_t face, uint32_t quad, const std::vector<Vec2>& uv, std::vector<Vec3>& positions,
                            std::vector<Vec3>& normals) const {
  const auto& i = *implementation_;
  positions.resize(uv.size()), normals.resize(uv.size());
  i.interpolate(face, quad, uv, 0, false);
  const size_t n = i.u.size();
  for (size_t k = 0; k < uv.size(); ++k) positions[k] = Vec3(i.p[k], i.p[n + k], i.p[2 * n + k]);
  // At a border's very points Embree's derivatives are of both sides of a crease, and zero at the corners of
  // boundaries.
  constexpr float kInward = 1.0f / 128;
  i.interpolate(face, quad, uv, kInward, true);
  for (size_t k = 0; k < uv.size(); ++k) {
    const Vec3 normal = cross(Vec3(i.du[k], i.du[n + k], i.du[2 * n + k]), Vec3(i.dv[k], i.dv[n + k], i.dv[2 * n + k]));
    const float l2 = length_squared(normal);
    normals[k] = l2 > 0 ? normal * (1 / std::sqrt(l2)) : Vec3(0);
  }
}

}  // namespace bdpt
