// The options of `bdpt bake`.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render_options.h"

namespace bdpt_tool {

// A lightmap's output and the names of its planes in a file.
struct BakeOutput {
  bdpt_output_desc desc;
  std::vector<std::string> layers;
};

struct BakeOptions {
  std::string what = "lightmap";  // probes or points
  RenderOptions render;           // what both commands have; the rest of it is not used
  int uv_set = 1;
  std::uint32_t resolution = 0;
  double texels_per_unit = 0;
  double reach = 0;     // of outputs that look how far it is open; 0 = without end
  std::string outputs;  // empty: what is usual
  std::string paths;    // "direct", "indirect" or both
  std::vector<std::string> subset;
  std::uint32_t gutter = 2;
  bool geometric_normals = false;
  bool files = false;             // one for each node
  std::string grid, box, points;  // "NX,NY,NZ", "x0,y0,z0,x1,y1,z1", a file
};

void add_bake_options(CLI::App& command, BakeOptions& options);

// From --outputs, or `usual` where that is not given, and --direct-only and --indirect-only. Throws an Error of kUsage.
std::vector<BakeOutput> bake_outputs(const BakeOptions& options, const std::string& usual);

// As technique_mask; but t = 1 of path tracing is the texel itself, which sees lamps directly.
TechniqueMask bake_techniques(const BakeOptions& options);

}  // namespace bdpt_tool
