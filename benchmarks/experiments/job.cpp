// SPDX-License-Identifier: Apache-2.0
#include "job.h"

#include "film_output.h"
#include "timing.h"

namespace bdpt_experiments {

using bdpt_benchmark::processor_seconds;

Job::Job(const Stage& stage, const Variant& variant, std::uint32_t max_edges, std::uint64_t seed,
         std::uint32_t pyramid_edges)
    : stage_(stage), variant_(variant) {
  auto film = bdpt_tool::sized<bdpt_film_desc>();
  film.pyramid_edges = pyramid_edges;
  film_ = bdpt_tool::make<bdpt_tool::Film>("the film", bdpt_film_create, stage.sensor.get(), &film);
  const bdpt_render_desc desc = render_desc(variant_, max_edges, seed);
  render_ = bdpt_tool::make<bdpt_tool::Render>(variant.name, bdpt_render_create, stage.scene.get(), stage.sensor.get(),
                                               film_.get(), &desc);
}

double Job::advance(std::uint64_t passes) {
  auto desc = bdpt_tool::sized<bdpt_advance_desc>();
  desc.passes = passes;
  const double before = processor_seconds();
  bdpt_tool::check(bdpt_render_advance(render_.get(), &desc, nullptr), variant_.name);
  return (processor_seconds() - before) / stage_.threads;
}

bdpt_tool::Image Job::color() const { return bdpt_tool::read_layer(film_.get(), BDPT_LAYER_COLOR, false); }

bdpt_render_stats Job::stats() const {
  auto stats = bdpt_tool::sized<bdpt_render_stats>();
  bdpt_tool::check(bdpt_render_get_stats(render_.get(), &stats), variant_.name);
  return stats;
}

bdpt_technique_stats Job::technique(std::uint32_t s, std::uint32_t t) const {
  auto stats = bdpt_tool::sized<bdpt_technique_stats>();
  bdpt_tool::check(bdpt_render_get_technique_stats(render_.get(), s, t, &stats), "the render");
  return stats;
}

std::vector<float> grey(const bdpt_tool::Image& image) {
  std::vector<float> values(image.pixels.size() / 3);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = (image.pixels[3 * i] + image.pixels[3 * i + 1] + image.pixels[3 * i + 2]) / 3;
  return values;
}

}  // namespace bdpt_experiments
