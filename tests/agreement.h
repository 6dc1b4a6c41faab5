// Whether two ways to render a scene agree: every 32 x 32 block, by independent seeds, with one threshold for the
// whole family of blocks; and whether the test could tell if they did not.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "scene_upload.h"
#include "technique_mask.h"

namespace bdpt_tool {

// One way to render: which techniques, how much.
struct Variant {
  std::string name;
  TechniqueMask techniques;
  std::uint64_t passes = 1;    // of each seed
  TechniqueMask planted = {};  // a factor of 1.02 on these must be noticed
};

// Mean of RGB in each block of an image, for each seed; [block][seed].
struct BlockMeans {
  std::vector<std::vector<double>> plain, planted;
  std::uint32_t columns = 0, rows = 0;
};

struct SceneUnderTest {
  Context context;
  Scene scene;
  Sensor sensor;
  std::uint32_t width, height, max_edges;  // of what is measured
};

struct Mean {
  double value, error;
  int degrees;
};
Mean mean_of(const std::vector<double>& values);

// The size of the image, and the part of it that is measured.
struct Frame {
  std::uint32_t width, height;
  std::array<std::uint32_t, 4> crop = {};  // x0, y0, x1, y1 in pixels; zeros: the whole image
};
SceneUnderTest load_scene(const std::string& path, const Frame& frame, std::uint32_t max_edges,
                          Diagnostics& diagnostics);

BlockMeans render_blocks(const SceneUnderTest& scene, const Variant& variant, int seeds, std::uint64_t first_seed);

// The quantile of Student's distribution that is exceeded, on either side, with this chance.
double student_quantile(double chance, double degrees);

// How two sets of block means compare.
struct Agreement {
  double worst = 0;             // largest deviation over its threshold: at most 1 where they agree
  double widest = 0;            // largest threshold over the block's mean
  double family_chance = 0.01;  // that any block of a true agreement fails
  std::string table;
};
// paired: both were rendered from the same seeds, so that what their common eye subpaths find alike, rare bright paths
// that s = 0 alone can make, is no noise of the difference.
Agreement compare_blocks(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b,
                         const std::vector<std::uint32_t>& skipped, bool paired = false);

}  // namespace bdpt_tool
