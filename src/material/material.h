// Materials: what a surface does with light. One interface, one table (material.cpp), a file for each kind.
//
// Directions are unit vectors in the local shading frame, z along the shading normal on the material's front, and
// point away from the surface. A subpath arrives from `previous` and leaves along `next`; the transport mode says
// which of the two is the side of the light. Densities are per solid angle, here and only here: src/transport
// divides them by cosines with the geometric normal to get Veach's densities per projected solid angle.
#pragma once

#include "math/vec.h"

namespace bdpt {

enum class TransportMode {
  Radiance,    // an eye subpath: next is the side of the light
  Importance,  // a light subpath: previous is the side of the light
};

enum class MaterialType {
  Diffuse,
  Mirror,
  Conductor,
  Dielectric,
  Interface,  // between media: there is nothing to see of it
  DiffuseTransmission,
  CoatedDiffuse,
  CoatedConductor,
  Principled,
  Mix,
  Host,
  Brushed,
  RoughDiffuse,  // Diffuse with a roughness
};

// A host's own material: f and both densities for two directions, and a direction for u. False: there is none.
class HostMaterial;

// The numbers of a material at a point of a surface.
struct Material {
  MaterialType type = MaterialType::Diffuse;
  Rgb reflectance;                 // of all but metals and glass; at a vertex it is the vertex's own that counts
  Rgb eta, k;                      // conductors
  float ior = 1.5f;                // dielectric, coated diffuse, principled: inside over outside
  float alpha_u = 0, alpha_v = 0;  // GGX; both zero = smooth
  bool single_scattering = false;  // GGX without what is scattered more than once
  bool one_sided = false;
  uint16_t encloses = 0;                  // number in the scene's Interiors; 0 = nothing that counts
  float diffuse_roughness = 0;            // Oren-Nayar's
  Rgb transmittance;                      // diffuse transmission; principled: colour of what goes through diffusely
  float coat = 0;                         // principled: weight
  float coat_ior = 1.5f, coat_alpha = 0;  // coated conductor, principled
  float metalness = 0, specular = 1;      // these and the following: principled
  Rgb specular_color{1};
  Rgb sheen;
  float sheen_alpha = 0;
  float transmission = 0, diffuse_transmission = 0;
  bool thin_walled = false;
  float anisotropy = 0;                    // alpha_u goes to 1 with its square
  float tangent_cos = 1, tangent_sin = 0;  // of the direction u in the tangent frame
  float film = 0;                          // weight of a thin film on the base
  float film_ior = 1.3f, film_thickness = 0;  // nanometres
  const Material* parts[2] = {};           // mix
  float mix = 0;                           // weight of the second
  const HostMaterial* host = nullptr;
  Rgb emission;
  bool emission_two_sided = false;
  float emission_exponent = 0;  // radiance goes with the cosine to this power
  uint32_t emission_group = 0;  // see LightDesc

  bool is_smooth() const { return alpha_u == 0; }
  // Whether directions along the surface matter.
  bool is_anisotropic() const {
    return alpha_u != alpha_v || anisotropy != 0 || type == MaterialType::Mix || type == MaterialType::Host ||
           type == MaterialType::Brushed;
  }
  // A dielectric whose two sides are optically the same: all light passes straight through, however rough.
  bool is_index_matched() const { return type == MaterialType::Dielectric && std::fabs(ior - 1) < 1e-4f; }
  // Whether it parts two media; else what is on its sides is the same.
  bool is_boundary() const {
    return type == MaterialType::Dielectric || type == MaterialType::Interface ||
           (type == MaterialType::Principled && transmission > 0 && !thin_walled);
  }
  // Whether light from one side may go on to the other.
  bool transmits() const;
  // True where all scattering is a Dirac: no connection can be made here (Veach 10.3.5). Where a part of it is, samples
  // say which part they are of.
  bool is_specular() const;
  // True where some of it is.
  bool has_specular() const;
};

// f_s for both directions given, with the densities of sampling one from the other.
struct BsdfValue {
  Rgb f;                      // per projected solid angle of the shading normal, scaled for the transport mode
  float density = 0;          // of sampling next, given previous
  float density_reverse = 0;  // of sampling previous, given next
};

struct BsdfSample {
  Vec3 next{0, 0, 0};
  Rgb weight;         // f |cos next| / density, cosine with the shading normal; black = absorbed
  float density = 0;  // of next; for a specular material the Dirac's coefficient, see below
  float density_reverse = 0;
  bool specular = false;  // of a Dirac
};
// Specular coefficients (Veach 10.3.5): with T the probability of the event chosen (reflection, refraction),
// density = T η_next² |cos next| and density_reverse = T η_previous² |cos previous|, η the index of the medium that
// direction is in. One Dirac in the microfacet normal is shared by both, and a bundle keeps η² |cos| dω, so their ratio
// is that of the true densities.

// The value for two directions, of all but Diracs: zero for a specular material, and for sides where the material
// scatters nothing. The densities are those of sample(), with the probability of the part that is no Dirac.
BsdfValue evaluate(const Material& material, const Rgb& reflectance, const Vec3& previous, const Vec3& next,
                   TransportMode mode);

// Samples next, given previous, from three uniform numbers in [0,1).
BsdfSample sample(const Material& material, const Rgb& reflectance, const Vec3& previous, TransportMode mode,
                  const float u[3]);

}  // namespace bdpt
