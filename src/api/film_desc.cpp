#include "api/film_desc.h"

namespace bdpt {

namespace {

constexpr uint32_t kDefaultGroups = 2, kMaxPyramidEdges = 15;

FilterDesc read_filter(const Subject& subject, const bdpt_film_desc& desc) {
  subject.check_enum("filter", desc.filter, BDPT_FILTER_BLACKMAN_HARRIS);
  if (desc.filter_radius != 0) subject.check_range("filter_radius", desc.filter_radius, 0.5, 8);
  subject.check_finite("filter_a", desc.filter_a);
  subject.check_finite("filter_b", desc.filter_b);
  // Within these the filter's integral is well away from zero, by which it is divided.
  if (desc.filter == BDPT_FILTER_GAUSSIAN && desc.filter_a != 0)
    subject.check_range("filter_a", desc.filter_a, 0.1f, 16);
  if (desc.filter == BDPT_FILTER_MITCHELL) {
    subject.check_range("filter_a", desc.filter_a, 0, 1);
    subject.check_range("filter_b", desc.filter_b, 0, 1);
  }
  return {static_cast<FilterType>(desc.filter), desc.filter_radius, desc.filter_a, desc.filter_b};
}

}  // namespace

SensorShape shape_of(const Sensor& sensor) {
  return {sensor.width(), sensor.height(), FilmPlanes(sensor), sensor.count(), sensor.is_local(), sensor.has_seams()};
}

FilmDesc read_film(const bdpt_film_desc& desc, const SensorShape& sensor) {
  const Subject subject("film", nullptr);
  FilmDesc film;
  film.width = sensor.width;
  film.height = sensor.height;
  film.filter = read_filter(subject, desc);
  subject.check_enum("normalization", desc.normalization, BDPT_NORMALIZATION_SAMPLE_COUNT);
  film.normalize_by_weights = desc.normalization == BDPT_NORMALIZATION_FILTER_WEIGHTS_BIASED;
  if (desc.groups > uint32_t(kMaxGroups)) subject.check_range("groups", desc.groups, 1, kMaxGroups);
  film.groups = int(desc.groups == 0 ? kDefaultGroups : desc.groups);
  subject.check_range("pyramid_edges", desc.pyramid_edges, 0, kMaxPyramidEdges);
  film.pyramid_edges = int(desc.pyramid_edges);
  const bool is_pixel = film.filter.type == FilterType::Box && (film.filter.radius == 0 || film.filter.radius == 0.5f);
  if (sensor.has_seams && !is_pixel)
    subject.refuse("filter", "would mix the faces of a cube map: leave filter and filter_radius zero");
  film.planes = sensor.planes.planes;
  film.unfiltered = sensor.planes.unfiltered;
  film.counts = sensor.planes.counts;
  film.coverages = sensor.planes.coverages;
  if (!sensor.is_local) return film;
  if (!is_pixel)
    subject.refuse("filter", "is none for a sensor that has no pixels: leave filter and filter_radius zero");
  film.one_image = true;
  film.measured = sensor.count;
  return film;
}

}  // namespace bdpt
