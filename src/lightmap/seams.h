// Both sides of a seam made to agree, by least squares.
#pragma once

#include "lightmap/seam_edges.h"

namespace bdpt {

struct SeamImage {
  uint32_t width = 0, height = 0;
  const float* pixels = nullptr;
  const uint8_t* mask = nullptr;  // or NULL: all texels have a value
};

struct SeamSolve {
  uint32_t channels = 0;    // of all images
  double lambda = 0.01;     // > 0: how much texels resist, against a texel's length of seam
  double tolerance = 1e-6;  // of the residual, relative to the right-hand side
  uint32_t max_iterations = 1000;
};

struct SeamFix {
  struct Texel {
    uint32_t image;
    size_t texel;
  };
  std::vector<Texel> texels;  // that change
  std::vector<float> values;  // channels floats for each
  uint64_t samples = 0;
  uint64_t samples_skipped = 0;  // outside the image, or near a texel without a value
  uint64_t not_finite = 0;       // texels that the mask has, and that were looked at
  double error_before = 0;       // root of the mean square difference across the seams, over all channels
  double error_after = 0;
  uint32_t iterations = 0;  // the most of any channel
  bool converged = true;
};

// Minimises  sum_s w_s (B_a T - B_b T)^2 + lambda |T - T0|^2  over the texels T that bilinear lookups along the seams
// read: the samples s lie half a texel apart, B_a and B_b look up both sides, w_s is the length they stand for in
// texels. Conjugate gradients, channel by channel, in a fixed order.
SeamFix solve_seams(const std::vector<Seam>& seams, const std::vector<SeamImage>& images, const SeamSolve& options);

}  // namespace bdpt
