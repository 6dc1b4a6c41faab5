// The vertices of subpaths. Eye and light subpaths are made of the same vertices by the same code; only the transport
// mode tells them apart.
//
// Conventions of this folder, after Veach (1997), chapter 10:
//   y_0 ... y_{s-1}      light subpath, y_0 on a light
//   z_{t-1} ... z_0      eye subpath, z_0 on the sensor
//   x_0 ... x_k          the path, x_0 = y_0, x_k = z_0, k = s + t - 1
//   z_0                  lives in EyeStart; of a local sensor it is a Vertex, too, the first of its subpath
//   own, other           a vertex's own side is the end its subpath started from; the other side is the other end
//   density              per area, in the product measure; `projected` densities are per projected solid angle, with
//                        the geometric normal, P_sigma-perp of Veach. P_A = P_sigma-perp G
//   throughput           alpha_i (10.6), (10.7): all factors up to this vertex
#pragma once

#include "geometry/margin.h"
#include "light/lights.h"
#include "material/material.h"
#include "math/vec.h"
#include "medium/medium.h"
#include "scene/interiors.h"

#include <cstdint>
#include <limits>

namespace bdpt {

// A vertex on a surface or in a medium: y_1, y_2, ... or z_1, z_2, ...; y_0 and a camera's z_0 live in LightStart and
// EyeStart alone. In a medium there is no normal: the cosines are 1, and densities are per volume.
struct Vertex {
  Vec3 p;
  float density;           // P_A of this vertex, as its own side samples it
  Vec3 ng;                 // geometric normal, on the surface's front
  float geometry;          // G(this <-> previous), times the density of coming so far from here; of z_1, if z_0 is in
                           // a volume, over the chord's length there
  Vec3 ns;                 // shading normal
  float sums;              // v_i of mis.h
  Vec3 previous;           // unit direction toward the previous vertex
  float technique;         // u_i of mis.h
  Vec3 tangent;            // for anisotropic materials
  float previous_reverse;  // P_A of the previous vertex, as the other side samples it coming from here
  Rgb throughput;          // alpha
  Rgb reflectance;
  const Material* material;  // the scene's, or in the subpaths' store; nullptr in a medium
  const Medium* medium;      // where light scatters in one
  Interior interior;         // what encloses the way to the previous vertex
  uint32_t previous_index;   // in the block's vertices of this side; kNoVertex where the previous is none of them
  float previous_density;    // P_A of the previous vertex, as its own side samples it
  float outer;               // light side: v_i without the techniques that join inner vertices
  float direct;              // light side: P_A^d(y_0) / P_A(y_0) for y_0 and y_1 of this subpath
  float previous_cosine_g;   // of previous with ng
  float previous_cosine_s;   // of previous with ns
  uint32_t count;            // vertices of the subpath up to and with this one: s or t
  float margin;              // see off_surface()
  bool joinable;             // not all it scatters is a Dirac
  bool specular;             // the subpath went on by a Dirac (10.3.5)
  bool start_hittable;       // light side: eye subpaths can hit y_0
  bool start_finite;         // light side: y_0 is a point
  uint8_t group;             // light side: of y_0's light

  bool is_joinable() const { return joinable && !is_black(throughput); }
  bool is_sensor() const { return !material && !medium; }  // z_0 of a local sensor
  bool in_medium() const { return medium != nullptr; }
  Receiver receiver() const {
    return {p, in_medium() || (material && material->transmits()) ? Vec3(0) : is_sensor() ? ng : ns};
  }
  // The cosine with the geometric normal.
  float cosine(const Vec3& w) const { return in_medium() ? 1 : absdot(ng, w); }
};

inline constexpr uint32_t kNoVertex = ~0u;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();  // how far a ray goes that has no end

// f_s in geometric terms, and both densities, for two directions at a surface vertex.
struct Scattering {
  Rgb f;           // f_s (previous, next), to be used with G of geometric normals; Veach 5.3's correction for
                   // shading normals is part of it: f |w_light ns| / |w_light ng|
  float next;      // projected density of next, given previous
  float previous;  // projected density of previous, given next
};

// False where nothing is scattered from one direction into the other.
inline bool scatter(const Vertex& v, const Vec3& next, TransportMode mode, Scattering& out) {
  if (v.in_medium()) {
    const float phase = v.medium->phase(v.previous, next);
    out.f = v.medium->sigma_s * phase;
    out.next = out.previous = phase;
    return true;
  }
  const float gn = dot(v.ng, next), sn = dot(v.ns, next), gp = v.previous_cosine_g, sp = v.previous_cosine_s;
  if (!(gn * sn > 0) || !(gp * sp > 0)) return false;  // the two normals disagree about the side: light would leak
  float next_density, previous_density;
  if (v.material->type == MaterialType::Diffuse) {
    if (!(sn * sp > 0) || (v.material->one_sided && sn < 0)) return false;
    out.f = v.reflectance * kInvPi;
    next_density = std::fabs(sn) * kInvPi;
    previous_density = std::fabs(sp) * kInvPi;
  } else {
    const Frame frame = v.material->is_anisotropic() ? Frame(v.ns, v.tangent) : Frame(v.ns);
    const BsdfValue value =
        evaluate(*v.material, v.reflectance, frame.to_local(v.previous), frame.to_local(next), mode);
    if (is_black(value.f)) return false;
    out.f = value.f;
    next_density = value.density;
    previous_density = value.density_reverse;
  }
  const float next_cosine = 1 / std::fabs(gn), previous_cosine = 1 / std::fabs(gp);
  out.f *= mode == TransportMode::Radiance ? std::fabs(sn) * next_cosine : std::fabs(sp) * previous_cosine;
  out.next = next_density * next_cosine;
  out.previous = previous_density * previous_cosine;
  return true;
}

// Where rays between a vertex and w start or end. Points have no margin.
inline Vec3 off_surface(const Vertex& v, const Vec3& w) { return off_surface(v.p, v.ng, v.margin, w); }
inline Vec3 off_surface(const LightPoint& y0, const Vec3& w) { return off_surface(y0.p, y0.normal, y0.margin, w); }

}  // namespace bdpt
