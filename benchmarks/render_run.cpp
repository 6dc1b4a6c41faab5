// SPDX-License-Identifier: Apache-2.0
#include "render_run.h"

#include <cstddef>

namespace bdpt_benchmark {
namespace {

std::shared_ptr<bdpt::Film> make_film(const LoadedScene& scene) {
  bdpt::FilmDesc desc;
  desc.width = scene.sensor->width();
  desc.height = scene.sensor->height();
  desc.filter.type = bdpt::FilterType::Box;
  return std::make_shared<bdpt::Film>(desc, scene.meter);
}

bdpt::RenderDesc render_desc(const Integrator& integrator, std::uint64_t seed) {
  bdpt::RenderDesc desc;
  desc.transport = integrator.options;
  desc.seed = seed;
  return desc;
}

bdpt::TransportStats difference(bdpt::TransportStats a, const bdpt::TransportStats& b) {
  a.samples -= b.samples, a.eye_rays -= b.eye_rays, a.light_rays -= b.light_rays, a.shadow_rays -= b.shadow_rays;
  a.shadow_rays_blocked -= b.shadow_rays_blocked, a.connections -= b.connections, a.rejected -= b.rejected;
  a.start -= b.start, a.extend -= b.extend, a.extend_rays -= b.extend_rays, a.connect -= b.connect;
  a.shadow -= b.shadow, a.accumulate -= b.accumulate;
  return a;
}

}  // namespace

RenderRun::RenderRun(const LoadedScene& scene, const Integrator& integrator, std::shared_ptr<bdpt::Executor> executor,
                     std::uint64_t seed)
    : film_(make_film(scene)),
      render_(scene.scene, scene.sensor, film_, std::move(executor), scene.meter, render_desc(integrator, seed)) {}

Timing RenderRun::advance(std::uint64_t passes, bdpt::RayRecorder* recorder) {
  const bdpt::TransportStats before = render_.stats();
  bdpt::AdvanceDesc desc;
  const std::uint64_t pool = render_.engine().pool_passes;
  desc.passes = (passes + pool - 1) / pool * pool;
  render_.record(recorder);
  const bdpt::AdvanceReport report = render_.advance(desc);
  render_.record(nullptr);
  return {report.seconds, difference(render_.stats(), before)};
}

std::vector<float> RenderRun::grey_image() const {
  const int width = film_->desc().width, height = film_->desc().height;
  std::vector<float> rgb(std::size_t{3} * width * height), grey(rgb.size() / 3);
  film_->read(bdpt::FilmLayer::Color, 0, 0, {0, 0, width, height}, false, rgb.data(), std::size_t{3} * width);
  for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = (rgb[3 * i] + rgb[3 * i + 1] + rgb[3 * i + 2]) / 3;
  return grey;
}

}  // namespace bdpt_benchmark
