#include "bake/outputs.h"

#include "sampling/hash.h"

namespace bdpt {

void real_sh(const Vec3& w, int planes, float* y) {
  y[0] = 0.28209479177387814f;
  if (planes < 4) return;
  constexpr float c1 = 0.48860251190291992f;
  y[1] = c1 * w.y, y[2] = c1 * w.z, y[3] = c1 * w.x;
  if (planes < 9) return;
  constexpr float c2 = 1.0925484305920792f, c20 = 0.31539156525252005f, c22 = 0.54627421529603959f;
  y[4] = c2 * w.x * w.y, y[5] = c2 * w.y * w.z, y[6] = c20 * (3 * w.z * w.z - 1), y[7] = c2 * w.x * w.z,
  y[8] = c22 * (w.x * w.x - w.y * w.y);
}

int Outputs::planes_of(const OutputDesc& output) {
  if (is_octahedral(output.kind)) return output.size * output.size;
  switch (output.kind) {
    case OutputKind::RadianceSh1:
    case OutputKind::IrradianceSh1:
    case OutputKind::OpennessSh1:
      return 4;
    case OutputKind::RadianceSh2:
    case OutputKind::IrradianceSh2:
    case OutputKind::OpennessSh2:
      return 9;
    default:
      return 1;
  }
}

namespace {

Seen seen_by(OutputKind kind) {
  switch (kind) {
    case OutputKind::Openness:
    case OutputKind::OpennessSh1:
    case OutputKind::OpennessSh2:
      return Seen::Openness;
    case OutputKind::BentNormal:
      return Seen::Direction;
    case OutputKind::DistanceOctahedral:
      return Seen::Distance;
    case OutputKind::Fronts:
      return Seen::Fronts;
    case OutputKind::Unshadowed:
      return Seen::Unshadowed;
    default:
      return Seen::Light;
  }
}

}  // namespace

Outputs::Outputs(const std::vector<OutputDesc>& outputs) : descs_(outputs) {
  int first = 0;
  for (const OutputDesc& o : descs_) {
    OutputPlanes planes{};
    planes.first = first, planes.count = planes_of(o);
    planes.direct = o.direct, planes.indirect = o.indirect, planes.groups = o.groups;
    planes.kind = int(o.kind);
    planes.seen = seen_by(o.kind);
    if (o.reach > 0) planes.reach = o.reach;
    list_.push_back(planes);
    octahedra_.push_back(is_octahedral(o.kind) ? Octahedron(o.size) : Octahedron());
    first += planes.count;
  }
}

bool Outputs::respond(bool on_surface, bool normals_differ) const {
  const OutputKind base = on_surface ? OutputKind::Irradiance : OutputKind::Fluence;
  for (const OutputDesc& o : descs_)
    if (o.kind != base || (on_surface && normals_differ)) return true;
  return false;
}

void Outputs::evaluate(const Vec3& w, const Vec3& shading, float cosine, float* response) const {
  const float per_cosine = 1 / cosine;
  for (size_t i = 0; i < descs_.size(); ++i) {
    float* out = response + list_[i].first;
    const int planes = list_[i].count;
    switch (descs_[i].kind) {
      case OutputKind::Irradiance:
      case OutputKind::BentNormal:
      case OutputKind::Unshadowed:
        out[0] = std::max(0.0f, dot(w, shading)) * per_cosine;
        break;
      case OutputKind::IrradianceOverPi:
      case OutputKind::Openness:
        out[0] = std::max(0.0f, dot(w, shading)) * per_cosine * kInvPi;
        break;
      case OutputKind::Fluence:
        out[0] = per_cosine;
        break;
      case OutputKind::Fronts:
        out[0] = 1;
        break;
      case OutputKind::RadianceOctahedral:
      case OutputKind::DistanceOctahedral: {
        std::fill(out, out + planes, 0.0f);
        const int texel = octahedra_[i].texel(w);
        out[texel] = per_cosine / octahedra_[i].angles[size_t(texel)];
        break;
      }
      case OutputKind::IrradianceOctahedral:
        for (int p = 0; p < planes; ++p)
          out[p] = std::max(0.0f, dot(w, octahedra_[i].directions[size_t(p)])) * per_cosine;
        break;
      case OutputKind::RadianceSh1:
      case OutputKind::RadianceSh2:
      case OutputKind::IrradianceSh1:
      case OutputKind::IrradianceSh2:
      case OutputKind::OpennessSh1:
      case OutputKind::OpennessSh2: {
        real_sh(w, planes, out);
        const bool irradiance =
            descs_[i].kind == OutputKind::IrradianceSh1 || descs_[i].kind == OutputKind::IrradianceSh2;
        for (int p = 0; p < planes; ++p)
          out[p] *= per_cosine * (!irradiance ? 1 : p == 0 ? kPi : p < 4 ? kTwoPi / 3 : kPi / 4);
        break;
      }
    }
  }
}

uint64_t Outputs::hash() const {
  uint64_t h = hash_values(descs_.size());
  for (const OutputDesc& o : descs_) h = hash_combine(h, hash_values(int(o.kind), o.direct, o.indirect, o.groups));
  for (const OutputDesc& o : descs_)
    if (o.size > 0) h = hash_combine(h, hash_values(o.size));
  for (const OutputDesc& o : descs_)
    if (o.reach > 0) h = hash_bytes(&o.reach, sizeof(o.reach), h);
  return h;
}

}  // namespace bdpt
