// Films, as the host asks for them.
#pragma once

#include "api/check.h"
#include "api/desc.h"
#include "film/film.h"

namespace bdpt {

// What a film must know of a sensor.
struct SensorShape {
  int width, height;
  FilmPlanes planes;
  uint64_t count;
  bool is_local;
  bool has_seams = false;
};
SensorShape shape_of(const Sensor& sensor);

FilmDesc read_film(const bdpt_film_desc& desc, const SensorShape& sensor);

}  // namespace bdpt
