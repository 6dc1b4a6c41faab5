// A thin transparent film on a smooth base: what both reflect interferes, and is coloured (Belcour and Barla 2017).
//
// With the real amplitudes r of the film's outside and r' of its inside, a = r r', and d the phase by which light falls
// behind on its way through the film and back, Airy's sum of all reflections is for each polarisation
//   R = 1 - K (1 + 2 SUM (-a)^m cos(m d)), K = (1 - r^2) (1 - r'^2) / (1 - a^2).
// d is 2 pi D / wavelength, D the way's optical length. Each colour channel has the mean over wavelengths, weighted by
// what it sees of them: of the cosines there remain functions of m D alone, and these are tables.
#pragma once

#include "math/vec.h"

namespace bdpt {

// The means of cos(2 pi D / wavelength) over wavelengths as linear Rec. 709 sees them; 1 for D = 0. The observer is CIE
// 1931's, all wavelengths alike are white.
class FilmCosines {
 public:
  static const FilmCosines& get();

  Rgb at(float nanometres) const;

 private:
  FilmCosines();

  static constexpr int kNodes = 2048;
  static constexpr float kStep = 6;  // nanometres
  Rgb cosines_[kNodes];
};

// Indices are over that of what is outside of the film.
class ThinFilm {
 public:
  ThinFilm(float ior, float nanometres) : ior_(ior), thickness_(nanometres) {}

  // Seen from outside; base_f0: what the base alone reflects at normal incidence.
  Rgb reflectance(float cosine, const Rgb& base_f0) const;
  // The base refracts.
  Rgb reflectance_on(float base_ior, float cosine) const;
  // The most that is reflected of any wavelength at normal incidence.
  float most(float base_f0) const;

 private:
  struct Incidence;

  float ior_, thickness_;
};

}  // namespace bdpt
