// How much of what arrives a layer of GGX microfacets scatters, with single scattering: what compensates for the rest,
// and what a layer leaves for what is below, depend on it. Tables, computed at first use.
#pragma once

#include "material/microfacet.h"

namespace bdpt {

// Of microfacets that reflect all light, and of such that reflect (1 - cosine)^5, Schlick's.
struct SchlickAlbedo {
  float all, grazing;
};

// Means over the cosine-weighted hemisphere have one argument less.
class MetalAlbedo {
 public:
  static const MetalAlbedo& get();

  float all(float alpha, float cosine) const;
  float all_mean(float alpha) const;
  SchlickAlbedo both(float alpha, float cosine) const;
  SchlickAlbedo both_mean(float alpha) const;

 private:
  MetalAlbedo();

  static constexpr int kAlphas = 32, kCosines = 32;
  float all_[kAlphas][kCosines], grazing_[kAlphas][kCosines];
  float all_mean_[kAlphas], grazing_mean_[kAlphas];
};

// Of a boundary between two media; eta is the index on the other side over that on the side of the light, in [0.1, 10].
class BoundaryAlbedo {
 public:
  static const BoundaryAlbedo& get();

  // Where an index is in the tables; that of its reciprocal comes without a logarithm.
  struct Eta {
    int node;
    float part;
    Eta reciprocal() const;
  };
  static Eta at(float eta);

  float reflected(float alpha, float cosine, const Eta& eta) const;
  float reflected_mean(float alpha, const Eta& eta) const;
  // Reflected and refracted, as energy.
  float all(float alpha, float cosine, const Eta& eta) const;
  float all_mean(float alpha, const Eta& eta) const;

 private:
  BoundaryAlbedo();

  static constexpr int kAlphas = 16, kCosines = 24, kEtas = 33;
  float reflected_[kEtas][kAlphas][kCosines], all_[kEtas][kAlphas][kCosines];
  float reflected_mean_[kEtas][kAlphas], all_mean_[kEtas][kAlphas];
};

// Of Charlie's sheen (sheen.h).
class SheenAlbedo {
 public:
  static const SheenAlbedo& get();

  float all(float alpha, float cosine) const;

 private:
  SheenAlbedo();

  static constexpr int kAlphas = 16, kCosines = 32;
  float all_[kAlphas][kCosines];
};

// The alpha of the isotropic surface that scatters about as much of what comes from v.
float isotropic_alpha(const Ggx& ggx, const Vec3& v);

}  // namespace bdpt
