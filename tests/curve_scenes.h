// Curves for scenes, made from arrays as the C ABI makes them.
#pragma once

#include "api/curves_data.h"
#include "scenes.h"

namespace bdpt::scenes {

struct Strands {
  CurveBasis basis = CurveBasis::Linear;
  std::vector<ControlPoint> points;
  std::vector<uint32_t> counts;  // empty: one strand
};

inline std::shared_ptr<const Curves> make_curves(const Strands& strands) {
  const auto view = [](const void* data, size_t count, size_t stride, bdpt_format format) {
    bdpt_data d{};
    d.data = data, d.count = count, d.stride = stride, d.format = format;
    return d;
  };
  bdpt_curves_desc desc{};
  desc.struct_size = sizeof desc;
  desc.basis = bdpt_curve_basis(strands.basis);
  desc.positions = view(strands.points.data(), strands.points.size(), sizeof(ControlPoint), BDPT_FORMAT_FLOAT3);
  desc.radii = view(&strands.points[0].radius, strands.points.size(), sizeof(ControlPoint), BDPT_FORMAT_FLOAT1);
  desc.counts = view(strands.counts.data(), strands.counts.size(), sizeof(uint32_t), BDPT_FORMAT_UINT32);
  return read_curves(desc, std::make_shared<MemoryMeter>(0));
}

inline Shape curves(const Strands& strands) { return {nullptr, nullptr, make_curves(strands)}; }

// One strand of three segments that bends and tapers, within the unit ball, in any basis.
inline Strands bent(CurveBasis basis, float scale = 1, float taper = 0.5f) {
  std::vector<ControlPoint> points = {{Vec3(-0.9f, -0.2f, 0.1f), 0.2f},  {Vec3(-0.6f, 0.2f, 0), 0.17f},
                                      {Vec3(-0.2f, 0.3f, -0.2f), 0.15f}, {Vec3(0.2f, 0.1f, -0.1f), 0.12f},
                                      {Vec3(0.5f, 0, 0.2f), 0.1f},       {Vec3(0.9f, 0.3f, 0.1f), 0.2f * taper}};
  if (basis == CurveBasis::Linear) points.resize(4);
  if (basis == CurveBasis::Bezier)
    for (const Vec3& p : {Vec3(1.2f, 0.6f, 0), Vec3(1.2f, 1, 0.1f), Vec3(1, 1.3f, 0), Vec3(0.7f, 1.4f, 0)})
      points.push_back({p, 0.1f});
  if (basis == CurveBasis::Bezier) points[4].p = points[3].p * 2.0f - points[2].p, points.resize(10);
  for (ControlPoint& p : points) p.p *= scale, p.radius *= scale;
  return {basis, points, {}};
}

inline constexpr CurveBasis kBases[] = {CurveBasis::Linear, CurveBasis::Bezier, CurveBasis::BSpline,
                                        CurveBasis::CatmullRom};

}  // namespace bdpt::scenes
