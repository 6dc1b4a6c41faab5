// What is wrong with a layout of lightmap coordinates, and what it is like.
#pragma once

#include "lightmap/claims.h"

#include <optional>

namespace bdpt {

struct UvCheckOptions {
  Atlas atlas;
  uint32_t padding_reach = 16;
  uint64_t max_overlaps = 1'000'000;  // pairs; the search ends there
  bool map_overlaps = false;
};

struct UvCheck {
  uint64_t triangles = 0;
  uint64_t charts = 0;
  uint64_t outside_rect = 0;     // triangles with a corner outside their instance's rectangle
  uint64_t outside_atlas = 0;    // and outside the atlas
  uint64_t without_uv_area = 0;  // triangles
  uint64_t without_world_area = 0;
  uint64_t mirrored = 0;  // triangles
  uint64_t texels_claimed = 0;
  uint64_t texels_shared = 0;     // claimed by more than one chart
  uint64_t overlaps_within = 0;   // pairs of triangles of one chart
  uint64_t overlaps_between = 0;  // pairs of triangles of two charts
  double overlap_area_within = 0;
  double overlap_area_between = 0;
  bool overlaps_cut = false;                                  // there are more than max_overlaps
  double density_min = 0, density_mean = 0, density_max = 0;  // texels per world unit
  std::optional<uint32_t> padding;

  Charts triangle_charts;
  Claims claims;
  std::vector<uint32_t> texel_overlaps;  // pairs that overlap in the texel; where map_overlaps
};

UvCheck check_uv(const std::vector<UvMesh>& meshes, const UvCheckOptions& options);

}  // namespace bdpt
