// SPDX-License-Identifier: Apache-2.0
#include "contest.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bdpt_experiments {
namespace {

// Turns have seeds from 1 on.
constexpr std::uint64_t kTrialSeed = 0, kReferenceSeed = 1000'000;

std::uint64_t rounded(std::uint64_t passes, std::uint64_t step) {
  return std::max(passes / step, std::uint64_t{1}) * step;
}

// How many passes take `seconds`, by the time of those that do: a render that is thrown away.
std::uint64_t passes_for(double seconds, const Stage& stage, const Variant& variant, const ContestOptions& options) {
  const std::uint64_t step = passes_at_once(variant);
  Job job(stage, variant, options.max_edges, kTrialSeed, options.pyramid_edges);
  job.advance(step);  // warms up
  std::uint64_t passes = 0;
  double spent = 0;
  for (std::uint64_t next = step; spent < seconds / 4; next *= 2) {
    spent += job.advance(next);
    passes += next;
  }
  return rounded(std::uint64_t(std::lround(double(passes) * seconds / spent)), step);
}

// The numbers of passes at which to look, each once.
std::vector<std::uint64_t> looks(std::uint64_t passes, std::size_t count, std::uint64_t step) {
  std::vector<std::uint64_t> result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(rounded(passes >> (count - 1 - i), step));
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

void take_turn(const Stage& stage, Contestant& contestant, std::size_t turn, const ContestOptions& options) {
  auto job = std::make_unique<Job>(stage, contestant.variant, options.max_edges, turn + 1, options.pyramid_edges);
  double spent = 0;
  std::uint64_t done = 0;
  for (Checkpoint& checkpoint : contestant.checkpoints) {
    spent += job->advance(checkpoint.passes - done);
    done = checkpoint.passes;
    checkpoint.seconds.push_back(spent);
    checkpoint.images.push_back(grey(job->color()));
  }
  if (turn > 0) return;
  contestant.picture = job->color();
  contestant.stats = job->stats();
  contestant.first = std::move(job);
}

double seconds(const Checkpoint& checkpoint, std::size_t without) {
  double sum = 0;
  for (std::size_t i = 0; i < checkpoint.seconds.size(); ++i)
    if (i != without) sum += checkpoint.seconds[i];
  return sum / double(checkpoint.seconds.size() - (without < checkpoint.seconds.size() ? 1 : 0));
}

double relative_variance(const Checkpoint& c, std::size_t without) {
  return bdpt_experiments::relative_variance(c.images, without, *c.reference);
}

}  // namespace

std::vector<Contestant> hold(const Stage& stage, const std::vector<Variant>& variants, const ContestOptions& options) {
  std::vector<Contestant> contestants;
  double time = 0;
  for (const Variant& variant : variants) {
    if (!lacks(variant).empty()) continue;
    Contestant contestant;
    contestant.variant = variant;
    const std::uint64_t step = passes_at_once(variant);
    std::uint64_t passes = rounded(options.passes, step);
    if (options.equal_time && contestants.empty()) {
      Job job(stage, variant, options.max_edges, kTrialSeed, options.pyramid_edges);
      job.advance(step);
      time = job.advance(passes);
    } else if (options.equal_time) {
      passes = passes_for(time, stage, variant, options);
    }
    for (const std::uint64_t look : looks(passes, options.checkpoints, step))
      contestant.checkpoints.push_back({look, {}, {}, nullptr});
    contestants.push_back(std::move(contestant));
  }
  for (std::size_t turn = 0; turn < options.turns; ++turn)
    for (Contestant& contestant : contestants) take_turn(stage, contestant, turn, options);
  Variant variant = contestants.front().variant;
  variant.sampler = BDPT_SAMPLER_SOBOL;
  Job job(stage, variant, options.max_edges, kReferenceSeed);
  job.advance(contestants.front().end().passes * options.turns);
  const auto reference = std::make_shared<const bdpt_benchmark::ImageVariance>(reference_of({grey(job.color())}));
  for (Contestant& contestant : contestants)
    for (Checkpoint& checkpoint : contestant.checkpoints) checkpoint.reference = reference;
  return contestants;
}

Estimate relative_variance(const Checkpoint& c) {
  return jackknife(c.images.size(), [&](std::size_t without) { return relative_variance(c, without); });
}

Estimate mean(const Checkpoint& c) {
  double sum = 0, squares = 0;
  for (const auto& image : c.images) {
    const double m = std::accumulate(image.begin(), image.end(), 0.0) / double(image.size());
    sum += m, squares += m * m;
  }
  const double n = double(c.images.size()), average = sum / n;
  return {average, std::sqrt(std::max(squares / n - average * average, 0.0) / (n - 1))};
}

Estimate mean_ratio(const Checkpoint& a, const Checkpoint& b) {
  if (&a == &b) return {1, 0};
  const Estimate x = mean(a), y = mean(b);
  return {x.value / y.value, x.value / y.value * std::hypot(x.error / x.value, y.error / y.value)};
}

double apart(const Checkpoint& a, const Checkpoint& b, double standard_errors) {
  const bdpt_benchmark::ImageVariance x = reference_of(a.images), y = reference_of(b.images);
  std::size_t count = 0;
  for (std::size_t i = 0; i < x.pixels(); ++i)
    count += std::fabs(x.mean(i) - y.mean(i)) > standard_errors * std::sqrt(x.mean_variance(i) + y.mean_variance(i));
  return double(count) / double(x.pixels());
}

double seconds(const Checkpoint& checkpoint) { return seconds(checkpoint, checkpoint.seconds.size()); }

Estimate efficiency_ratio(const Checkpoint& a, const Checkpoint& b) {
  return jackknife(a.images.size(), [&](std::size_t without) {
    return relative_variance(b, without) * seconds(b, without) / (relative_variance(a, without) * seconds(a, without));
  });
}

Estimate sample_ratio(const Checkpoint& a, const Checkpoint& b) {
  return jackknife(a.images.size(), [&](std::size_t without) {
    return relative_variance(b, without) * double(b.passes) / (relative_variance(a, without) * double(a.passes));
  });
}

}  // namespace bdpt_experiments
