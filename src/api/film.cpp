#include "api/check.h"
#include "api/desc.h"
#include "api/film_desc.h"
#include "api/handles.h"

using namespace bdpt;

namespace {

// A render counts on the passes that it found and made.
void check_not_rendered(const bdpt_film& film, const char* name) {
  film.busy.check(name);
  if (film.film->is_in_use())
    fail(ErrorCode::InUse, "the ", name, " is being filled by a render: destroy the render first");
}

bdpt_film_info info_of(const Film& film) {
  const FilmDesc& desc = film.desc();
  bdpt_film_info info{};
  info.width = uint32_t(desc.width);
  info.height = uint32_t(desc.height);
  info.groups = uint32_t(desc.groups);
  info.pyramid_edges = uint32_t(desc.pyramid_edges);
  info.filter = static_cast<bdpt_filter>(desc.filter.type);
  info.filter_radius = film.filter().radius();
  info.normalization =
      desc.normalize_by_weights ? BDPT_NORMALIZATION_FILTER_WEIGHTS_BIASED : BDPT_NORMALIZATION_SAMPLE_COUNT;
  info.planes = uint32_t(desc.planes);
  info.coverages = uint32_t(desc.coverages);
  info.measured = desc.measured > 0 ? desc.measured : uint64_t(desc.width) * uint64_t(desc.height);
  info.rejected = film.rejected();
  info.relative_error = film.relative_error();
  if (film.is_empty()) return info;
  info.passes = film.passes();
  info.first_pass = film.ranges().front().begin;
  info.next_pass = film.ranges().back().end;
  info.seed = film.recipe().seed;
  info.scene_hash = film.recipe().scene_hash;
  info.options_hash = film.recipe().options_hash;
  return info;
}

}  // namespace

bdpt_result bdpt_film_create(bdpt_sensor* sensor, const bdpt_film_desc* desc, bdpt_film** film) {
  return guard(__func__, [&] {
    reset_output(film);
    require(sensor, "sensor");
    const bdpt_film_desc d = read_optional_struct(desc, "desc");
    require(film, "film");
    auto object = std::make_unique<bdpt_film>();
    object->context = sensor->context;
    object->film = std::make_shared<Film>(read_film(d, shape_of(*sensor->sensor)), sensor->context->meter);
    *film = object.release();
  });
}

bdpt_result bdpt_film_estimate(const bdpt_sensor* sensor, const bdpt_film_desc* desc, bdpt_memory_estimate* estimate) {
  return guard(__func__, [&] {
    require(sensor, "sensor");
    const bdpt_film_desc d = read_optional_struct(desc, "desc");
    check_output_struct(estimate, "estimate");
    const FilmDesc film = read_film(d, shape_of(*sensor->sensor));
    bdpt_memory_estimate result{};
    result.film = Film::bytes_for(film);
    result.render = Render::bytes_of_blocks(*sensor->context->executor, film);
    result.total = result.film + result.render;
    write_struct(result, estimate);
  });
}

void bdpt_film_retain(bdpt_film* film) {
  if (film) film->retain();
}

void bdpt_film_release(bdpt_film* film) {
  if (film) film->release();
}

bdpt_result bdpt_film_get_info(const bdpt_film* film, bdpt_film_info* info) {
  return guard(__func__, [&] {
    require(film, "film");
    check_output_struct(info, "info");
    write_struct(info_of(*film->film), info);
  });
}

bdpt_result bdpt_film_clear(bdpt_film* film) {
  return guard(__func__, [&] {
    check_not_rendered(require(film, "film"), "film");
    film->film->clear();
  });
}

bdpt_result bdpt_film_merge(bdpt_film* destination, const bdpt_film* source) {
  return guard(__func__, [&] {
    check_not_rendered(require(destination, "destination"), "destination");
    require(source, "source").busy.check("source");
    if (destination == source) fail(ErrorCode::InvalidArgument, "source is the destination itself: pass two films");
    destination->film->merge(*source->film);
  });
}

bdpt_result bdpt_film_save(const bdpt_film* film, const char* path) {
  return guard(__func__, [&] {
    require(film, "film");
    check_path(path);
    film->film->save(path);
  });
}

bdpt_result bdpt_film_load(bdpt_context* context, const char* path, bdpt_film** film) {
  return guard(__func__, [&] {
    reset_output(film);
    require(context, "context");
    check_path(path);
    require(film, "film");
    auto object = std::make_unique<bdpt_film>();
    object->context = Ref<bdpt_context>(context);
    object->film = Film::load(path, context->meter);
    *film = object.release();
  });
}
