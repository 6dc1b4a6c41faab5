#include "lightmap/seams.h"

#include "lightmap/bilinear.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bdpt {
namespace {

constexpr double kSamplesPerTexel = 2;
// A texel that weighs less than this in a lookup need not have a value.
constexpr double kLeastWeight = 1e-9;

// One row of the least squares: sum of coefficients times unknowns ought to be zero.
struct Row {
  uint64_t unknowns[8];  // texels of all images, counted on; then their places among those in use
  double coefficients[8];
  int count = 0;
  double weight = 0;
};

class SeamSystem {
 public:
  SeamSystem(const std::vector<Seam>& seams, const std::vector<SeamImage>& images, uint32_t channels)
      : images_(images), channels_(channels) {
    uint64_t first = 0;
    for (const SeamImage& image : images) {
      first_.push_back(first);
      first += uint64_t(image.width) * image.height;
    }
    for (const Seam& seam : seams) add_rows(seam);
    number_unknowns();
    std::sort(not_finite_.begin(), not_finite_.end());
    not_finite_.erase(std::unique(not_finite_.begin(), not_finite_.end()), not_finite_.end());
  }

  size_t unknowns() const { return texels_.size(); }
  uint64_t samples() const { return rows_.size(); }
  uint64_t skipped() const { return skipped_; }
  uint64_t not_finite() const { return not_finite_.size(); }
  SeamFix::Texel texel(size_t unknown) const {
    const uint64_t t = texels_[unknown];
    const size_t image = size_t(std::upper_bound(first_.begin(), first_.end(), t) - first_.begin()) - 1;
    return {uint32_t(image), size_t(t - first_[image])};
  }
  double original(size_t unknown, uint32_t channel) const {
    const SeamFix::Texel t = texel(unknown);
    return images_[t.image].pixels[t.texel * channels_ + channel];
  }
  double difference(size_t row, const std::vector<double>& values) const {
    const Row& r = rows_[row];
    double sum = 0;
    for (int i = 0; i < r.count; ++i) sum += r.coefficients[i] * values[r.unknowns[i]];
    return sum;
  }
  // result += A^T W A values, A the rows.
  void multiply(const std::vector<double>& values, std::vector<double>& result) const {
    for (size_t row = 0; row < rows_.size(); ++row) {
      const double d = rows_[row].weight * difference(row, values);
      for (int i = 0; i < rows_[row].count; ++i) result[rows_[row].unknowns[i]] += rows_[row].coefficients[i] * d;
    }
  }
  double weighted_squares(const std::vector<double>& values) const {
    double sum = 0;
    for (size_t row = 0; row < rows_.size(); ++row) {
      const double d = difference(row, values);
      sum += rows_[row].weight * d * d;
    }
    return sum;
  }
  double total_weight() const {
    double sum = 0;
    for (const Row& row : rows_) sum += row.weight;
    return sum;
  }

 private:
  void add_rows(const Seam& seam) {
    const double length = std::max(length_inside(seam.a), length_inside(seam.b));
    const uint32_t n = std::max(1u, uint32_t(std::ceil(kSamplesPerTexel * length)));
    for (uint32_t i = 0; i < n; ++i) {
      const double t = (i + 0.5) / n;
      Row row;
      row.weight = length / n;
      const bool a = add_lookup(seam.a, t, 1, row), b = add_lookup(seam.b, t, -1, row);
      if (a && b)
        rows_.push_back(row);
      else
        ++skipped_;
    }
  }

  // A side's length in texels; what is longer than the image's two sides leaves it, and is cut to them.
  double length_inside(const SeamSide& side) const {
    const SeamImage& image = images_[side.atlas];
    return std::min((side.to - side.from).length(), double(image.width) + double(image.height));
  }

  bool add_lookup(const SeamSide& side, double t, double sign, Row& row) {
    const SeamImage& image = images_[side.atlas];
    const Vec2d point = side.from + (side.to - side.from) * t;
    if (!(point.x >= -kTexelTolerance && point.y >= -kTexelTolerance && point.x <= image.width + kTexelTolerance &&
          point.y <= image.height + kTexelTolerance))
      return false;
    const Footprint footprint = bilinear_footprint(point, image.width, image.height);
    bool whole = true;
    for (int i = 0; i < 4; ++i) {
      if (footprint.weights[i] < kLeastWeight) continue;
      whole &= has_value(side.atlas, footprint.texels[i]);
      row.unknowns[row.count] = first_[side.atlas] + footprint.texels[i];
      row.coefficients[row.count++] = sign * footprint.weights[i];
    }
    return whole;
  }

  bool has_value(uint32_t atlas, size_t texel) {
    const SeamImage& image = images_[atlas];
    if (image.mask && !image.mask[texel]) return false;
    const float* v = image.pixels + texel * channels_;
    if (std::all_of(v, v + channels_, [](float x) { return std::isfinite(x); })) return true;
    not_finite_.push_back(first_[atlas] + texel);
    return false;
  }

  void number_unknowns() {
    for (const Row& row : rows_) texels_.insert(texels_.end(), row.unknowns, row.unknowns + row.count);
    std::sort(texels_.begin(), texels_.end());
    texels_.erase(std::unique(texels_.begin(), texels_.end()), texels_.end());
    for (Row& row : rows_)
      for (int i = 0; i < row.count; ++i)
        row.unknowns[i] = uint64_t(std::lower_bound(texels_.begin(), texels_.end(), row.unknowns[i]) - texels_.begin());
  }

  const std::vector<SeamImage>& images_;
  uint32_t channels_;
  std::vector<uint64_t> first_;  // of each image's texels, in one count of all
  std::vector<Row> rows_;
  std::vector<uint64_t> texels_, not_finite_;
  uint64_t skipped_ = 0;
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

struct Solution {
  std::vector<double> change;
  uint32_t iterations = 0;
  bool converged = false;
};

// (A^T W A + lambda) change = -A^T W A original, by conjugate gradients (Hestenes and Stiefel 1952).
Solution solve_channel(const SeamSystem& system, const std::vector<double>& original, const SeamSolve& options) {
  const size_t n = original.size();
  Solution s;
  s.change.assign(n, 0);
  std::vector<double> residual(n), product(n);
  system.multiply(original, residual);
  for (double& r : residual) r = -r;
  std::vector<double> direction = residual;
  double squares = dot(residual, residual);
  const double enough = squares * options.tolerance * options.tolerance;
  for (; !(squares <= enough) && s.iterations < options.max_iterations; ++s.iterations) {
    for (size_t i = 0; i < n; ++i) product[i] = options.lambda * direction[i];
    system.multiply(direction, product);
    const double step = squares / dot(direction, product);
    for (size_t i = 0; i < n; ++i) {
      s.change[i] += step * direction[i];
      residual[i] -= step * product[i];
    }
    const double next = dot(residual, residual);
    for (size_t i = 0; i < n; ++i) direction[i] = residual[i] + next / squares * direction[i];
    squares = next;
  }
  s.converged = squares <= enough;
  return s;
}

}  // namespace

SeamFix solve_seams(const std::vector<Seam>& seams, const std::vector<SeamImage>& images, const SeamSolve& options) {
  const SeamSystem system(seams, images, options.channels);
  SeamFix fix;
  fix.samples = system.samples();
  fix.samples_skipped = system.skipped();
  fix.not_finite = system.not_finite();
  for (size_t i = 0; i < system.unknowns(); ++i) fix.texels.push_back(system.texel(i));
  fix.values.resize(system.unknowns() * options.channels);
  double before = 0, after = 0;
  std::vector<double> values(system.unknowns());
  for (uint32_t c = 0; c < options.channels; ++c) {
    for (size_t i = 0; i < values.size(); ++i) values[i] = system.original(i, c);
    before += system.weighted_squares(values);
    const Solution solution = solve_channel(system, values, options);
    for (size_t i = 0; i < values.size(); ++i) {
      constexpr double kLargest = std::numeric_limits<float>::max();
      const float value = float(std::clamp(values[i] + solution.change[i], -kLargest, kLargest));
      fix.values[i * options.channels + c] = value;
      values[i] = value;
    }
    after += system.weighted_squares(values);
    fix.iterations = std::max(fix.iterations, solution.iterations);
    fix.converged &= solution.converged;
  }
  const double weight = system.total_weight() * options.channels;
  if (weight > 0) {
    fix.error_before = std::sqrt(before / weight);
    fix.error_after = std::sqrt(after / weight);
  }
  return fix;
}

}  // namespace bdpt
