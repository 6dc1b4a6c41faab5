#include "transport/image_pilot.h"

#include "sampling/hash.h"
#include "transport/plan.h"

namespace bdpt {

namespace {

// Of each region squares of so many pixels a side, each so many times; where a sample's cost depends on the size of its
// block, as many as fill one. Rates of samples must know more than thresholds.
constexpr int kSide = 2;
constexpr uint32_t kPasses = 8, kSquares = 1, kSquaresForRates = 4;
uint32_t passes_for(const Plan& plan) {
  return plan.block_size > 0 && plan.passes == 1 ? plan.block_size / (kSide * kSide) : kPasses;
}
constexpr uint64_t kPool = 8192;

// Each hit of the light image is one of few, so that its variance is its square.
void add_light(const RegionGrid& grid, const Contribution& c, std::vector<RegionMeasure>& light) {
  const double v = double(norm(c.value));
  RegionMeasure& region = light[grid.region(c.film)];
  region.mean += v;
  region.variance += v * v;
}

}  // namespace

ImagePilot::ImagePilot(const Engine& engine)
    : engine_(engine),
      grid_(engine.bounds),
      passes_(passes_for(engine.plan)),
      squares_(engine.options.adaptive == Adaptive::None ? kSquares : kSquaresForRates),
      regions_(grid_.count()) {
  if (engine.plan.pooled) pool_.begin(kPool);
  const size_t tasks = pool_tasks() + row_tasks();
  light_.assign(tasks, std::vector<RegionMeasure>(grid_.count()));
  pool_rays_.assign(pool_tasks(), 0);
}

void ImagePilot::fill_pool(Block& block, uint32_t task) {
  const uint64_t before = block.stats().rays();
  pool_.fill(block, kPilotPass, task);
  for (const Contribution& c : block.contributions()) add_light(grid_, c, light_[task]);
  pool_rays_[task] = block.stats().rays() - before;
}

PixelRect ImagePilot::square(const PixelRect& region, int column, int row, uint32_t i) const {
  return square_within(region, kSide, hash_values(engine_.seed, 7, row, column, i));
}

void ImagePilot::run_row(Block& block, uint32_t row) {
  for (int column = 0; column < grid_.columns(); ++column) {
    const PixelRect r = grid_.rect(column, int(row));
    for (uint32_t i = 0; i < squares_; ++i)
      measure_square(block, square(r, column, int(row), i), row,
                     regions_[size_t(row) * size_t(grid_.columns()) + size_t(column)]);
  }
}

// Adds a square's share: the mean of its pixels, and the mean variance within one.
void ImagePilot::measure_square(Block& block, const PixelRect& square, uint32_t row, RegionMeasure& region) {
  const size_t pixels = size_t(engine_.measured(square));
  if (pixels == 0) return;
  const uint64_t before = block.stats().rays();
  std::vector<Rgb> samples(passes_ * pixels);
  for (const Contribution& c : block.sample_pilot(passes_, square, engine_.plan.pooled ? &pool_ : nullptr)) {
    if (engine_.belongs_to_eye(c.t))
      samples[c.sample] += c.value;
    else
      add_light(grid_, c, light_[pool_tasks() + row]);
  }
  for (size_t pixel = 0; pixel < pixels; ++pixel) {
    double sum = 0, squares = 0;
    for (size_t i = pixel; i < samples.size(); i += pixels) {
      const double value = double(norm(samples[i]));
      sum += value, squares += value * value;
    }
    region.mean += sum / double(samples.size()) / squares_;
    region.variance += std::max(0.0, squares - sum * sum / passes_) / (passes_ - 1) / double(pixels) / squares_;
  }
  region.rays += double(block.stats().rays() - before) / double(samples.size()) / squares_;
}

std::vector<RegionMeasure> ImagePilot::measures() const {
  std::vector<RegionMeasure> measures = regions_;
  double pool_rays = 0;
  for (uint64_t n : pool_rays_) pool_rays += double(n) / double(kPool) * engine_.options.light_samples;
  uint64_t pixels = 0;
  for (int row = 0; row < grid_.rows(); ++row)
    for (int column = 0; column < grid_.columns(); ++column) {
      const PixelRect r = grid_.rect(column, row);
      for (uint32_t i = 0; i < squares_; ++i) pixels += engine_.measured(square(r, column, row, i));
    }
  // The light subpaths of a pass for one of the pilot's; none where the plan wants none.
  const double traced = engine_.plan.pooled ? double(kPool) : double(pixels) * passes_ * engine_.options.light_samples;
  for (int row = 0; row < grid_.rows(); ++row)
    for (int column = 0; column < grid_.columns(); ++column) {
      const size_t i = size_t(row) * size_t(grid_.columns()) + size_t(column);
      const PixelRect r = grid_.rect(column, row);
      const double scale =
          traced > 0 ? double(engine_.light_per_pass()) / traced / (double(r.x1 - r.x0) * (r.y1 - r.y0)) : 0;
      for (const std::vector<RegionMeasure>& task : light_) {
        measures[i].mean += task[i].mean * scale;
        measures[i].variance += task[i].variance * scale;
      }
      measures[i].rays += pool_rays;
    }
  return measures;
}

}  // namespace bdpt
