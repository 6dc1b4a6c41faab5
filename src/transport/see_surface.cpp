// What eye subpaths meet first, for outputs of cameras that are not about light.
#include "transport/block.h"

namespace bdpt {

// The mean of f |cos| / P over directions sampled by P is the part of light that is sent on. Light's way is taken, on
// which refraction changes no energy.
Rgb Block::estimate_albedo(const Walker& w, const Surface& surface) {
  const Four u = draw(true, w.sample, w.count + 1, Purpose::Scatter);
  const Material& m = *surface.material;
  const Frame frame = m.is_anisotropic() ? Frame(surface.ns, surface.tangent) : Frame(surface.ns);
  const BsdfSample b =
      bdpt::sample(m, surface.reflectance, frame.to_local(-w.direction), TransportMode::Importance, u.u);
  return b.density > 0 && is_finite(b.weight) ? b.weight : Rgb();
}

void Block::see_surface(const Walker& w, const Hit& hit, const Surface& surface) {
  const EyeStart& z0 = eye_.starts[w.sample];
  for (const OutputPlanes& o : engine_.sensor.outputs()) {
    Rgb value;
    switch (o.seen) {
      case Seen::Albedo:
        value = estimate_albedo(w, surface);
        break;
      case Seen::Normal: {
        const Vec3 n = dot(surface.ng, w.direction) > 0 ? -surface.ns : surface.ns;
        value = {n.x, n.y, n.z};
        break;
      }
      case Seen::Depth: {
        const Sensor& camera = engine_.sensor;
        const float d =
            camera.depth(camera.moves() ? camera.motion(eye_.time(w.sample)).back_point(surface.p) : surface.p);
        value = {d, d * d, 1};
        break;
      }
      case Seen::Position:
        value = {surface.p.x, surface.p.y, surface.p.z};
        break;
      case Seen::Instance:
        engine_.film.add_coverage(size_t(o.first), z0.film, engine_.scene.instance_id(hit.instance));
        continue;
      case Seen::Material:
        engine_.film.add_coverage(size_t(o.first), z0.film, engine_.scene.material_id(hit.instance));
        continue;
      default:
        continue;
    }
    eye_sums_[w.sample * responses_.planes() + size_t(o.first)] += value * eye_weights_[w.sample];
  }
}

}  // namespace bdpt
