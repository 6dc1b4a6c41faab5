#include "scene/scene_hash.h"

#include "light/photometry.h"
#include "material/host.h"
#include "sampling/hash.h"

#include <array>

namespace bdpt {

namespace {

// Those that the first four kinds do not have; what is left at its default adds nothing.
template <class Add>
void add_numbers(const MaterialDesc& m, const Add& add) {
  const auto numbers = [](const MaterialDesc& d) {
    return std::array{d.diffuse_roughness,
                      d.transmittance.r,
                      d.transmittance.g,
                      d.transmittance.b,
                      d.coat,
                      d.coat_ior,
                      d.coat_alpha,
                      d.metalness,
                      d.specular,
                      d.specular_color.r,
                      d.specular_color.g,
                      d.specular_color.b,
                      d.sheen.r,
                      d.sheen.g,
                      d.sheen.b,
                      d.sheen_alpha,
                      d.transmission,
                      d.diffuse_transmission,
                      d.anisotropy,
                      d.tangent_cos,
                      d.tangent_sin,
                      d.mix,
                      float(d.mixed[0]),
                      float(d.mixed[1]),
                      float(d.thin_walled),
                      float(d.single_scattering)};
  };
  const auto own = numbers(m);
  if (own != numbers(MaterialDesc())) add(own);
}

}  // namespace

uint64_t hash_scene(const SceneDesc& desc) {
  uint64_t h = hash_values(desc.shapes.size(), desc.instances.size());
  const auto add = [&](const auto& value) { h = hash_bytes(&value, sizeof(value), h); };
  for (const Shape& s : desc.shapes) {
    if (s.mesh) {
      h = hash_combine(h, s.mesh->content_hash);
    } else if (s.curves) {
      h = hash_combine(h, s.curves->content_hash);
    } else {
      add(s.sphere->center);
      add(s.sphere->radius);
    }
  }
  for (const auto& t : desc.textures) h = hash_combine(h, t ? t->content_hash() : 0);
  for (const auto& t : desc.host_textures) {
    h = hash_combine(h, t->hash);
    add(t->maximum);
    add(t->step);
  }
  for (const MaterialDesc& m : desc.materials) {
    const float numbers[] = {m.reflectance.r, m.reflectance.g, m.reflectance.b, m.eta.r,      m.eta.g,
                             m.eta.b,         m.k.r,           m.k.g,           m.k.b,        m.ior,
                             m.alpha_u,       m.alpha_v,       m.emission.r,    m.emission.g, m.emission.b};
    add(numbers);
    h = hash_combine(h, hash_values(int(m.type), m.one_sided, m.emission_two_sided));
    if (m.emission_group > 0) h = hash_combine(h, m.emission_group);
    if (m.film > 0) add(std::array{m.film, m.film_ior, m.film_thickness, m.least_film_thickness});
    add_numbers(m, add);
    const auto add_lookup = [&](int texture, int channel, const UvMap& uv, const TextureSampler& s) {
      add(uv.m);
      add(s.level);
      h = hash_combine(h, hash_values(texture, channel, uv.set, int(s.wrap_u), int(s.wrap_v), int(s.filter)));
    };
    for (const TextureUse& use : m.textures) {
      add_lookup(use.texture, use.channel, use.uv, use.sampler);
      add(use.scale);
      h = hash_combine(h, hash_values(int(use.slot), use.squared));
      if (use.is_hosts) h = hash_combine(h, 1);
    }
    if (m.interior >= 0 || m.priority > 0) h = hash_combine(h, hash_values(m.interior, m.priority));
    if (m.opacity.mode != Opacity::Mode::Opaque) {
      const Opacity& o = m.opacity;
      add(o.value);
      add(o.cutoff);
      h = hash_combine(h, uint64_t(o.mode));
      add_lookup(o.texture, o.channel, o.uv, o.sampler);
    }
    if (m.emission_exponent != 0) add(m.emission_exponent);
    if (m.host) h = hash_combine(h, m.host->hash);
  }
  for (const auto& medium : desc.media) {
    const float numbers[] = {medium->sigma_a.r, medium->sigma_a.g, medium->sigma_a.b, medium->sigma_s.r,
                             medium->sigma_s.g, medium->sigma_s.b, medium->g};
    add(numbers);
  }
  if (desc.outside >= 0) h = hash_combine(h, uint64_t(desc.outside));
  for (const LightDesc& l : desc.lights) {
    const float numbers[] = {l.position.x,  l.position.y,  l.position.z,  l.direction.x, l.direction.y,
                             l.direction.z, l.intensity.r, l.intensity.g, l.intensity.b, l.radiance.r,
                             l.radiance.g,  l.radiance.b,  l.cos_outer,   l.cos_inner};
    add(numbers);
    h = hash_combine(h, uint64_t(l.type));
    if (l.group > 0) h = hash_combine(h, l.group);
    if (l.type == LightType::Directional) {
      add(l.irradiance);
      add(l.angular_radius);
    }
    if (l.texture) {
      h = hash_combine(h, l.texture->content_hash());
      add(l.transform.m);
    }
    if (l.photometry) h = hash_combine(h, l.photometry->hash());
    if (l.photometry || l.texture) add(l.up);
    for (const Portal& p : l.portals) {
      add(p.corner);
      add(p.edge_u);
      add(p.edge_v);
    }
  }
  for (const InstanceDesc& i : desc.instances) {
    add(i.transform.m);
    h = hash_combine(h, hash_values(i.shape, i.material));
    if (i.invisible) h = hash_combine(h, 1);
    if (i.moves) add(i.end.m);
  }
  return h;
}

}  // namespace bdpt
