// Every kind of camera, for the tests that all of them share. A new kind gets a line here.
#pragma once

#include "scenes.h"

#include <ostream>

namespace bdpt::scenes {

// A plano-convex singlet of f = 50, and a double Gauss of f = 50 at f/2, after US patent 2,673,491 (Tronnier), scaled.
inline std::vector<LensSurface> singlet() { return {{25.85f, 6, 1.517f, 24}, {0, 47, 1, 24}}; }
inline std::vector<LensSurface> double_gauss() {
  return {{29.475f, 3.76f, 1.67f, 25.2f}, {84.83f, 0.12f, 1, 25.2f},    {19.275f, 4.025f, 1.67f, 23},
          {40.77f, 3.275f, 1.699f, 23},   {12.75f, 5.705f, 1, 18},      {0, 4.5f, 1, 17.1f},
          {-14.495f, 1.18f, 1.603f, 17},  {40.77f, 6.065f, 1.658f, 20}, {-20.385f, 0.19f, 1, 20},
          {437.065f, 3.22f, 1.717f, 20},  {-39.73f, 36.1f, 1, 20}};
}

struct CameraKind {
  std::string name;
  CameraDesc desc;
  float darkness = 0;  // of a uniformly bright world: the part of the picture that is black; a lens vignettes besides
};

inline void PrintTo(const CameraKind& kind, std::ostream* stream) { *stream << kind.name; }

inline void crop(CameraDesc& d, int x0, int y0, int x1, int y1) {
  d.crop[0] = x0, d.crop[1] = y0, d.crop[2] = x1, d.crop[3] = y1;
}
inline void reflect(CameraDesc& d) {
  for (int row = 0; row < 3; ++row) d.transform.m[4 * row] *= -1;
}

// Pictures of 24 x 24 pixels in all, but for the cube's 48 x 8.
inline std::vector<CameraKind> camera_kinds(const Viewpoint& view) {
  std::vector<CameraKind> kinds;
  const auto add = [&](const std::string& name, CameraType type, const auto& change, float darkness = 0) {
    CameraDesc d = camera_desc(view, type == CameraType::Cube ? 48 : 24, type == CameraType::Cube ? 8 : 24);
    d.type = type;
    change(d);
    kinds.push_back({name, d, darkness});
  };
  const auto thin = [](CameraDesc& d) { d.lens_radius = 0.1f, d.focus_distance = 1.2f; };
  const auto circle = float(1 - M_PI / 4);
  add("pinhole", CameraType::Perspective, [](CameraDesc&) {});
  add("leaning plane in focus", CameraType::Perspective, [&](CameraDesc& d) {
    thin(d);
    d.lens_radius = 0.2f;
    d.aperture_blades = 5;
    d.focus_tilt[0] = 60, d.focus_tilt[1] = -70;
    d.shift[0] = 0.1f;
  });
  add("orthographic", CameraType::Orthographic, [](CameraDesc& d) {
    d.field_height = 1.6f;
    d.shift[1] = -0.1f;
    reflect(d);
  });
  add(
      "equidistant", CameraType::Equidistant, [](CameraDesc& d) { d.field_of_view = 180; }, circle);
  add(
      "equisolid, all around", CameraType::Equisolid, [](CameraDesc& d) { d.field_of_view = 360; }, circle);
  add("equidistant, full frame", CameraType::Equidistant, [](CameraDesc& d) {
    d.field_of_view = 250;
    d.width = 40, d.height = 36;
    crop(d, 8, 6, 32, 30);
  });
  add("equirectangular", CameraType::Equirectangular, reflect);
  add("cube", CameraType::Cube, [](CameraDesc&) {});
  add("singlet", CameraType::Lens, [](CameraDesc& d) {
    d.lens = singlet();
    d.focus_distance = 1.2f;
    d.lens_unit = 0.008f;
    d.film_height = 60;
  });
  add("double Gauss", CameraType::Lens, [](CameraDesc& d) {
    d.lens = double_gauss();
    d.focus_distance = 1.2f;
    d.lens_unit = 0.007f;
    d.film_height = 30;
    d.aperture_blades = 5;
    reflect(d);
  });
  return kinds;
}

}  // namespace bdpt::scenes
