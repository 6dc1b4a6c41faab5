// SPDX-License-Identifier: Apache-2.0
#include "advance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "progress_bar.h"

namespace bdpt_tool {
namespace {

// One call of the library after another, each as long as a checkpoint, as if they were one.
class Advance {
 public:
  Advance(const RenderOptions& options, const PassRange& range, bdpt_cancel* cancel)
      : options_(options), passes_(range.end == 0 ? 0 : range.end - range.first), cancel_(cancel) {}

  // False when a limit is reached.
  bool step(bdpt_render* render) {
    auto desc = sized<bdpt_advance_desc>();
    desc.passes = passes_ == 0 ? 0 : passes_ - done_passes_;
    desc.seconds = slice();
    desc.noise = options_.noise;
    desc.cancel = cancel_;
    desc.progress = on_progress;
    desc.progress_user = this;
    auto report = sized<bdpt_advance_report>();
    check(bdpt_render_advance(render, &desc, &report), "the render");
    done_passes_ += report.passes;
    seconds_ += report.seconds;
    error_ = report.relative_error;
    samples_ += slice_samples_;
    return report.reason == BDPT_STOP_TIME && seconds_ < time_limit() && (passes_ == 0 || done_passes_ < passes_);
  }

 private:
  double time_limit() const {
    return options_.seconds > 0 ? options_.seconds : std::numeric_limits<double>::infinity();
  }
  bool in_slices() const { return !options_.film.empty() && options_.checkpoint > 0; }
  double slice() const {
    if (!in_slices()) return options_.seconds;
    return std::max(std::min(options_.checkpoint, time_limit() - seconds_), 1e-9);
  }

  // The library knows the slice, not the whole.
  static std::int32_t on_progress(void* user, const bdpt_progress* slice) {
    auto& self = *static_cast<Advance*>(user);
    bdpt_progress whole = *slice;
    if (self.in_slices()) {
      whole.passes += self.done_passes_;
      whole.seconds += self.seconds_;
      double fraction = whole.seconds / self.time_limit();
      if (self.passes_ > 0) fraction = std::max(fraction, double(whole.passes) / double(self.passes_));
      if (self.options_.noise > 0 && self.error_ > 0)
        fraction = std::max(fraction, std::pow(self.options_.noise / self.error_, 2));
      whole.fraction = self.fraction_ = std::clamp(fraction, self.fraction_, 1.0);
      self.slice_samples_ = slice->samples;
      whole.samples += self.samples_;
    }
    return ProgressBar::callback(&self.bar_, &whole);
  }

  const RenderOptions& options_;
  std::uint64_t passes_;  // 0 = no limit
  bdpt_cancel* cancel_;
  ProgressBar bar_;
  std::uint64_t done_passes_ = 0, samples_ = 0, slice_samples_ = 0;
  double seconds_ = 0, error_ = -1, fraction_ = 0;
};

}  // namespace

void advance(bdpt_render* render, const bdpt_film* film, const RenderOptions& options, const PassRange& range,
             bdpt_cancel* cancel) {
  if (range.end != 0 && range.end <= range.first) return;
  Advance advance(options, range, cancel);
  while (advance.step(render)) save_film(film, options);
}

void save_film(const bdpt_film* film, const RenderOptions& options) {
  const std::string& path = options.film;
  if (path.empty()) return;
  if (bdpt_film_save(film, path.c_str()) < 0)
    throw Error(ExitCode::kOutput, "cannot write '" + path + "': " + bdpt_last_error());
}

}  // namespace bdpt_tool
