// The material of glTF 2.0 and its extensions, and of OpenPBR where these agree: metal, or a dielectric with gloss over
// what is diffuse or lets light through, below a clear coat, below sheen.
//
// Layers are symmetric in both directions and give out no more than they receive. With T(v) the part of light that what
// is above lets through, seen from v, a diffuse lobe is multiplied by T(p) T(n) / mean T and keeps all that comes down;
// a lobe of microfacets by min(T(p), T(n)).
//
// A thin film changes what metal, gloss and glass reflect. What is below the gloss gets what the film lets through of
// any wavelength at least, so that no channel gives out more than it receives.
#include <array>

#include "material/boundary.h"
#include "material/compensation.h"
#include "material/kinds.h"
#include "material/oren_nayar.h"
#include "material/sheen.h"
#include "material/thin_film.h"

namespace bdpt {
namespace {

enum Lobe { Coat, Gloss, Glass, Thin, Diffuse, Through, Fibres, kLobes };
using Chances = std::array<float, kLobes>;

Rgb one_minus(const Rgb& c) { return Rgb(1) - c; }
Rgb schlick(const Rgb& f0, const Rgb& f90, float cosine) { return f0 + (f90 - f0) * schlick_part(cosine); }

class Principled {
 public:
  Principled(const Material& m, const Rgb& base, const Vec3& previous)
      : m_(m),
        base_(base),
        ggx_(m.alpha_u + (1 - m.alpha_u) * sqr(m.anisotropy), m.alpha_v),
        coat_(m.coat_alpha, m.coat_alpha),
        smooth_(m.is_smooth() && m.anisotropy == 0),
        refracts_(m.is_boundary()),
        front_(!refracts_ || previous.z > 0),
        film_(m.film_ior, m.film_thickness),
        film_part_(m.film) {
    metal_ = m.metalness;
    glass_ = (1 - metal_) * m.transmission;
    solid_ = (1 - metal_) * (1 - m.transmission);
    const float f0 = sqr((m.ior - 1) / (m.ior + 1));
    const auto channel = [&](float color) { return std::min(f0 * color, 1.0f) * m.specular; };
    f0_ = {channel(m.specular_color.r), channel(m.specular_color.g), channel(m.specular_color.b)};
    f90_ = Rgb(m.specular);
    layer_f0_ = f0_;
    if (film_part_ > 0) {
      bare_f0_ = {std::min(f0 * m.specular_color.r, 1.0f), std::min(f0 * m.specular_color.g, 1.0f),
                  std::min(f0 * m.specular_color.b, 1.0f)};
      film_f0_ = {film_.most(bare_f0_.r), film_.most(bare_f0_.g), film_.most(bare_f0_.b)};
      layer_f0_ = f0_ + (film_f0_ * m.specular - f0_) * film_part_;
    }
    through_ = refracts_ ? 0 : m.diffuse_transmission;
    coat_f0_ = sqr((m.coat_ior - 1) / (m.coat_ior + 1));
  }

  bool is_smooth() const { return smooth_; }
  bool is_smooth_coat() const { return m_.coat_alpha == 0; }
  // Below a whole film no more than single scattering is known.
  Boundary boundary() const { return {m_.ior, ggx_, smooth_, m_.single_scattering || film_part_ == 1}; }
  const Ggx& ggx() const { return ggx_; }
  const Ggx& coat_ggx() const { return coat_; }

  // What there is to see from one direction.
  struct Sight {
    float sheen = 0, under_sheen = 1, coat = 0;  // albedos
    float above = 1;                             // what is above the base lets so much through
    Rgb gloss;                                   // the dielectric's gloss reflects so much
    float loss = 0;                              // of microfacets, by single scattering
    Chances chances{};
  };

  // From behind there is nothing above the base.
  Sight sight(const Vec3& v, bool front) const {
    const float cosine = std::min(std::fabs(v.z), 1.0f);
    Sight s;
    if (front && !is_black(m_.sheen)) {
      // Not more than 1, as the lobe is not: at the horizon Charlie's would be.
      s.sheen = SheenAlbedo::get().all(m_.sheen_alpha, cosine);
      s.under_sheen = std::max(1 - norm(m_.sheen) * std::min(s.sheen, 1.0f), 0.0f);
    }
    if (front && m_.coat > 0) {
      const SchlickAlbedo a =
          is_smooth_coat() ? SchlickAlbedo{1, schlick_part(cosine)} : MetalAlbedo::get().both(m_.coat_alpha, cosine);
      s.coat = m_.coat * (coat_f0_ * (a.all - a.grazing) + a.grazing);
    }
    s.above = (1 - s.coat) * s.under_sheen;
    const SchlickAlbedo a =
        smooth_ ? SchlickAlbedo{1, schlick_part(cosine)} : MetalAlbedo::get().both(isotropic_alpha(ggx_, v), cosine);
    s.gloss = layer_f0_ * (a.all - a.grazing) + f90_ * a.grazing;
    if (!smooth_) s.loss = std::clamp((1 - a.all) * sure_part(ggx_), 0.0f, 1.0f);
    return s;
  }

  // With the chances of choosing each lobe.
  Sight full_sight(const Vec3& v, bool front) const {
    Sight s = sight(v, front);
    const float cosine = std::min(std::fabs(v.z), 1.0f);
    const float gloss = norm(s.gloss), below = s.above * std::max(1 - gloss, 0.0f), base = norm(base_);
    Chances& c = s.chances;
    c[Coat] = s.coat * s.under_sheen;
    c[Fibres] = norm(m_.sheen) * std::min(s.sheen, 1.0f);
    const float metal_f0 = film_part_ > 0 ? std::max(base, film_part_ * film_.most(base)) : base;
    const float metal = metal_f0 + (1 - metal_f0) * schlick_part(cosine);
    c[Gloss] = s.above * (metal_ * metal * (1 - s.loss) + (m_.thin_walled ? glass_ + solid_ : solid_) * gloss);
    if (refracts_) c[Glass] = s.above * glass_;
    if (m_.thin_walled) c[Thin] = below * glass_ * base * (1 - s.loss);
    c[Diffuse] = below * solid_ * (1 - through_) * base + s.above * metal_ * base * base * s.loss;
    c[Through] = below * solid_ * through_ * norm(m_.transmittance);
    if (m_.thin_walled) c[Through] += below * glass_ * base * s.loss;
    float sum = 0;
    for (float x : c) sum += x;
    for (float& x : c) x = sum > 0 ? x / sum : 0;
    return s;
  }

  // For p on the front and n on either side, both turned; all but Diracs.
  BsdfValue value(const Sight& from, const Vec3& p, const Vec3& n, TransportMode mode) const {
    const bool reflects = n.z > 0;
    const Sight to = full_sight(n, is_front(n));
    const float least = std::min(from.above, to.above);
    const float cos_n = std::fabs(n.z);
    BsdfValue v;
    const auto add = [&](Lobe lobe, const Rgb& f, float density, float reverse) {
      v.f += f;
      v.density += from.chances[lobe] * density;
      v.density_reverse += to.chances[lobe] * reverse;
    };
    const float diffuse = solid_ * (reflects ? 1 - through_ : through_);
    const float gloss = m_.thin_walled ? glass_ + solid_ : solid_;
    const Rgb light = diffuse > 0 ? below(from, to, is_front(n)) * diffuse : Rgb(0);
    if (reflects) {
      const OrenNayar rough(m_.diffuse_roughness);
      if (diffuse > 0 || metal_ > 0)
        add(Diffuse, diffuse > 0 ? light * rough.f(base_, p, n) : Rgb(0), rough.density(n.z), rough.density(p.z));
      if (!smooth_ && (metal_ > 0 || gloss > 0)) {
        const MicrofacetReflection r = reflect_at_microfacets(ggx_, p, n);
        add(Gloss, fresnel(r.cos_h) * (least * r.f), r.density, r.density_reverse);
        if (metal_ > 0 && !m_.single_scattering) v.f += MetalLoss(ggx_, p, n).f(schlick_mean(base_)) * (least * metal_);
      }
      if (front_ && m_.coat > 0 && !is_smooth_coat()) {
        const MicrofacetReflection r = reflect_at_microfacets(coat_, p, n);
        const float f = m_.coat * (coat_f0_ + (1 - coat_f0_) * schlick_part(r.cos_h)) * r.f;
        add(Coat, Rgb(f * std::min(from.under_sheen, to.under_sheen)), r.density, r.density_reverse);
      }
      if (front_ && !is_black(m_.sheen))
        add(Fibres, m_.sheen * (Sheen(m_.sheen_alpha).f(p, n) / std::max({from.sheen, to.sheen, 1.0f})), 0.5f * kInvPi,
            0.5f * kInvPi);
    } else {
      add(Through, light * m_.transmittance * kInvPi, cos_n * kInvPi, p.z * kInvPi);
      if (m_.thin_walled && glass_ > 0 && !smooth_) {
        const Vec3 mirrored(n.x, n.y, -n.z);
        const MicrofacetReflection r = reflect_at_microfacets(ggx_, p, mirrored);
        const Rgb f = one_minus(dielectric(std::min(r.cos_h, 1.0f))) * base_ * (glass_ * least);
        add(Thin, f * r.f, r.density, r.density_reverse);
        if (!m_.single_scattering) {
          const MetalLoss lost = loss(from, to);
          v.f +=
              one_minus(schlick_mean(layer_f0_)) * base_ * (glass_ * least * compensation(lost.p, lost.n, lost.mean));
        }
      }
    }
    if (refracts_) {
      const Vec3 previous = front_ ? p : Vec3(p.x, p.y, -p.z), next = front_ ? n : Vec3(n.x, n.y, -n.z);
      BsdfValue g = evaluate(boundary(), previous, next, mode);
      if (film_part_ > 0 && !is_black(g.f)) {
        // Without more than single scattering, what was added by it is nothing.
        const bool is_once = boundary().single_scattering;
        const Rgb once = is_once ? g.f : evaluate({m_.ior, ggx_, smooth_, true}, previous, next, mode).f;
        g.f = once * film_on_glass(p, n) + (g.f - once) * (1 - film_part_);
      }
      add(Glass, g.f * (reflects ? Rgb(1) : base_) * (glass_ * least), g.density, g.density_reverse);
    }
    return v;
  }

  // Of metal and gloss together, where the microfacets' normal has this cosine.
  Rgb fresnel(float cosine) const {
    const float c = std::min(cosine, 1.0f);
    return metal(c) * metal_ + dielectric(c) * (m_.thin_walled ? glass_ + solid_ : solid_);
  }
  // A mirror's weight.
  Rgb coat_mirror(const Sight& s) const { return Rgb(s.coat * s.under_sheen); }
  Rgb gloss_mirror(const Sight& s, const Vec3& p) const { return fresnel(p.z) * s.above; }
  Rgb straight_through(const Sight& s, const Vec3& p) const {
    return one_minus(dielectric(std::min(p.z, 1.0f))) * base_ * (glass_ * s.above);
  }
  Rgb through_glass(const Sight& from, const Sight& to, const Vec3& p, const Vec3& n) const {
    const Rgb weight = (n.z > 0 ? Rgb(1) : base_) * (glass_ * std::min(from.above, to.above));
    return film_part_ > 0 ? weight * film_on_glass(p, n) : weight;
  }
  // Whether v, turned, is on a side that has the layers above.
  bool is_front(const Vec3& v) const { return !refracts_ || (v.z > 0) == front_; }

 private:
  Rgb metal(float cosine) const {
    const Rgb bare = schlick(base_, Rgb(1), cosine);
    return film_part_ > 0 ? bare + (film_.reflectance(cosine, base_) - bare) * film_part_ : bare;
  }
  // Of the gloss.
  Rgb dielectric(float cosine) const {
    const Rgb bare = schlick(f0_, f90_, cosine);
    if (!(film_part_ > 0)) return bare;
    const Rgb most = schlick(film_f0_, Rgb(1), cosine), film = film_.reflectance(cosine, bare_f0_);
    const Rgb bound(std::min(film.r, most.r), std::min(film.g, most.g), std::min(film.b, most.b));
    return bare + (bound * m_.specular - bare) * film_part_;
  }
  // What the film makes of the boundary's reflectance or transmittance: the factor.
  Rgb film_on_glass(const Vec3& p, const Vec3& n) const {
    const float eta = front_ ? m_.ior : 1 / m_.ior;
    const bool reflects = n.z > 0;
    const Vec3 half = reflects ? p + n : p + n * eta;
    const float cos_p = std::min(std::fabs(dot(p, half)) / length(half), 1.0f);
    const float cos2_t = refracted_cosine_squared(cos_p, eta);
    if (!(cos2_t > 0)) return Rgb(1);
    const float cos_t = std::sqrt(cos2_t), bare = fresnel_dielectric(cos_p, cos_t, eta);
    const Rgb film = film_.reflectance_on(m_.ior, front_ ? cos_p : cos_t);
    const Rgb whole = Rgb(bare) + (film - Rgb(bare)) * film_part_;
    if (reflects) return bare > 1e-6f ? whole * (1 / bare) : Rgb(1);
    return bare < 1 ? one_minus(whole) * (1 / (1 - bare)) : Rgb(1);
  }
  MetalLoss loss(const Sight& from, const Sight& to) const { return MetalLoss(ggx_, from.loss, to.loss); }

  // T(p) T(n) / mean T of all that is above the diffuse base.
  Rgb below(const Sight& from, const Sight& to, bool front) const {
    const Rgb t = one_minus(from.gloss) * one_minus(to.gloss) * (from.above * to.above);
    Rgb mean;
    if (!front || (m_.coat == 0 && is_black(m_.sheen))) {
      const SchlickAlbedo a =
          smooth_ ? SchlickAlbedo{1, kSchlickMean} : MetalAlbedo::get().both_mean(isotropic_alpha(ggx_, Vec3(0, 0, 1)));
      mean = one_minus(layer_f0_ * (a.all - a.grazing) + f90_ * a.grazing);
    } else {
      // Gauss's rule for 2 cos d(cos).
      static constexpr float kCosines[] = {0.355051026f, 0.844948974f};
      static constexpr float kWeights[] = {0.363917296f, 0.636082704f};
      for (int i = 0; i < 2; ++i) {
        const Sight s = sight(Vec3(safe_sqrt(1 - sqr(kCosines[i])), 0, kCosines[i]), true);
        mean += one_minus(s.gloss) * (s.above * kWeights[i]);
      }
    }
    const auto ratio = [](float a, float b) { return b > 1e-6f ? a / b : 0; };
    return {ratio(t.r, mean.r), ratio(t.g, mean.g), ratio(t.b, mean.b)};
  }

  const Material& m_;
  Rgb base_;
  Ggx ggx_, coat_;
  bool smooth_, refracts_, front_;
  float metal_, glass_, solid_, through_, coat_f0_;
  Rgb f0_, f90_;
  ThinFilm film_;
  float film_part_;
  Rgb bare_f0_, film_f0_;  // of the gloss: without specular, and the film's most
  Rgb layer_f0_;           // what is below the gloss gets no more than this leaves
};

// Turns a direction into the frame of the grooves, or back.
Vec3 turned(const Material& m, const Vec3& v, float back) {
  if (m.tangent_sin == 0 && m.tangent_cos == 1) return v;
  const float s = back * m.tangent_sin;
  return {m.tangent_cos * v.x + s * v.y, m.tangent_cos * v.y - s * v.x, v.z};
}

BsdfValue evaluate_principled(const Material& m, const Rgb& base, const Vec3& previous, const Vec3& next,
                              TransportMode mode) {
  if (std::fabs(previous.z) < kMinCosine || std::fabs(next.z) < kMinCosine || is_blind_side(m, previous)) return {};
  const Vec3 p = to_front(previous, turned(m, previous, 1)), n = to_front(previous, turned(m, next, 1));
  if (n.z < 0 && !m.transmits()) return {};
  const Principled principled(m, base, previous);
  return principled.value(principled.full_sight(p, principled.is_front(p)), p, n, mode);
}

BsdfSample sample_principled(const Material& m, const Rgb& base, const Vec3& previous, TransportMode mode,
                             const float u[3]) {
  if (std::fabs(previous.z) < kMinCosine || is_blind_side(m, previous)) return {};
  const Principled principled(m, base, previous);
  const Vec3 local = turned(m, previous, 1), p = to_front(previous, local);
  const Principled::Sight from = principled.full_sight(p, principled.is_front(p));
  const Chances& chances = from.chances;
  int lobe = 0;
  float rest = u[2];
  while (lobe < kLobes && !(rest < chances[size_t(lobe)])) rest -= chances[size_t(lobe++)];
  if (lobe == kLobes) {  // by rounding; or nothing is scattered
    while (lobe > 0 && chances[size_t(--lobe)] == 0) {
    }
    if (chances[size_t(lobe)] == 0) return {};
    rest = 0;
  }
  const float chance = chances[size_t(lobe)];
  Vec3 n;
  switch (lobe) {
    case Coat:
    case Gloss:
    case Thin: {
      if (lobe == Coat ? principled.is_smooth_coat() : principled.is_smooth()) {
        if (lobe == Coat) return mirrored(previous, principled.coat_mirror(from), chance);
        if (lobe == Gloss) return mirrored(previous, principled.gloss_mirror(from, p), chance);
        BsdfSample s = mirrored(previous, principled.straight_through(from, p), chance);
        s.next.z = -s.next.z;
        return s;
      }
      const Ggx& ggx = lobe == Coat ? principled.coat_ggx() : principled.ggx();
      const Vec3 h = ggx.sample_visible(p, u[0], u[1]);
      n = h * (2 * dot(p, h)) - p;
      if (n.z < kMinCosine) return {};
      if (lobe == Thin) n.z = -n.z;
      break;
    }
    case Glass: {
      const float numbers[3] = {u[0], u[1], std::min(rest / chance, 0x1.fffffep-1f)};
      BsdfSample s = sample(principled.boundary(), local, mode, numbers);
      if (!(s.density > 0)) return {};
      n = to_front(previous, s.next);
      if (s.specular) {
        const Principled::Sight to = principled.full_sight(n, principled.is_front(n));
        s.weight *= principled.through_glass(from, to, p, n) * (1 / chance);
        s.next = turned(m, s.next, -1);
        return sampled_dirac(s, chance, to.chances[Glass]);
      }
      break;
    }
    case Diffuse:
      n = OrenNayar(m.diffuse_roughness).sample(u[0], u[1]);
      break;
    case Through:
      n = sample_cosine_hemisphere(u[0], u[1]);
      n.z = -n.z;
      break;
    default: {
      const float z = 1 - u[0], r = safe_sqrt(1 - z * z), phi = kTwoPi * u[1];
      n = {r * std::cos(phi), r * std::sin(phi), z};
    }
  }
  if (std::fabs(n.z) < kMinCosine) return {};
  const BsdfValue value = principled.value(from, p, n, mode);
  return sampled(turned(m, to_front(previous, n), -1), value);
}

bool transmits(const Material& m) { return m.transmission > 0 || m.diffuse_transmission > 0; }
bool has_specular(const Material& m) {
  if (m.coat > 0 && m.coat_alpha == 0) return true;
  return (m.is_smooth() && m.anisotropy == 0) || (m.is_boundary() && std::fabs(m.ior - 1) < 1e-4f);
}
// Of these a metal or a glass without anything else is all that has no lobe but Diracs.
bool is_specular(const Material& m) {
  const bool smooth = m.is_smooth() && m.anisotropy == 0;
  return smooth && (m.coat == 0 || m.coat_alpha == 0) && is_black(m.sheen) && (m.metalness == 1 || m.transmission == 1);
}

}  // namespace

const MaterialKind kPrincipledKind{evaluate_principled, sample_principled, is_specular, transmits, has_specular};

}  // namespace bdpt
