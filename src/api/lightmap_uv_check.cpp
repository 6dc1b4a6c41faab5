#include "api/check.h"
#include "api/desc.h"
#include "api/lightmap_buffers.h"
#include "api/lightmap_instances.h"
#include "lightmap/uv_check.h"

#include <algorithm>
#include <limits>

using namespace bdpt;

namespace {

constexpr uint32_t kMaxReach = 1024;

UvCheckOptions read_options(const bdpt_uv_check_desc& desc) {
  const Subject subject("desc", nullptr);
  check_atlas_size(subject, desc.width, desc.height);
  subject.check_range("padding_reach", desc.padding_reach, 0, kMaxReach);
  subject.check_reserved("reserved", desc.reserved);
  UvCheckOptions options;
  options.atlas = {desc.width, desc.height, desc.atlas};
  if (desc.padding_reach) options.padding_reach = desc.padding_reach;
  if (desc.max_overlaps) options.max_overlaps = desc.max_overlaps;
  return options;
}

void check_map(const Subject& subject, const char* field, const uint32_t* map, uint64_t capacity, uint64_t count) {
  if (map) check_buffer(subject, field, map, alignof(uint32_t), capacity, count * sizeof(uint32_t));
}

void check_maps(const bdpt_uv_maps& maps, const std::vector<UvMesh>& meshes, const Atlas& atlas) {
  const Subject subject("maps", nullptr);
  uint64_t triangles = 0;
  for (const UvMesh& mesh : meshes) triangles += mesh.triangles.size();
  subject.check_reserved("reserved", maps.reserved);
  check_map(subject, "triangle_charts", maps.triangle_charts, maps.triangle_charts_capacity, triangles);
  check_map(subject, "texel_charts", maps.texel_charts, maps.texel_charts_capacity, atlas.texels());
  check_map(subject, "texel_claims", maps.texel_claims, maps.texel_claims_capacity, atlas.texels());
  check_map(subject, "texel_overlaps", maps.texel_overlaps, maps.texel_overlaps_capacity, atlas.texels());
}

void write_maps(const UvCheck& check, const bdpt_uv_maps& maps) {
  const auto write = [](const std::vector<uint32_t>& from, uint32_t* to) {
    if (to) std::copy(from.begin(), from.end(), to);
  };
  if (uint32_t* to = maps.triangle_charts)
    for (const std::vector<uint32_t>& ids : check.triangle_charts.of_triangles)
      to = std::copy(ids.begin(), ids.end(), to);
  write(check.claims.charts, maps.texel_charts);
  write(check.claims.counts, maps.texel_claims);
  write(check.texel_overlaps, maps.texel_overlaps);
}

float to_float(double v) { return float(std::min(v, double(std::numeric_limits<float>::max()))); }

bdpt_uv_report to_report(const UvCheck& check) {
  bdpt_uv_report report{};
  report.padding = check.padding ? int32_t(*check.padding) : -1;
  report.triangles = check.triangles;
  report.charts = check.charts;
  report.outside_rect = check.outside_rect;
  report.outside_atlas = check.outside_atlas;
  report.zero_area_uv = check.without_uv_area;
  report.zero_area_world = check.without_world_area;
  report.mirrored = check.mirrored;
  report.texels_claimed = check.texels_claimed;
  report.texels_shared = check.texels_shared;
  report.overlaps_within = check.overlaps_within;
  report.overlaps_between = check.overlaps_between;
  report.overlap_area_within = check.overlap_area_within;
  report.overlap_area_between = check.overlap_area_between;
  report.density_min = to_float(check.density_min);
  report.density_mean = to_float(check.density_mean);
  report.density_max = to_float(check.density_max);
  report.overlaps_cut = check.overlaps_cut;
  return report;
}

}  // namespace

bdpt_result bdpt_uv_check(const bdpt_uv_check_desc* desc, const bdpt_uv_maps* maps, bdpt_uv_report* report) {
  return guard(__func__, [&] {
    const bdpt_uv_check_desc d = read_struct(desc, "desc");
    const bdpt_uv_maps m = read_optional_struct(maps, "maps");
    check_output_struct(report, "report");
    UvCheckOptions options = read_options(d);
    options.map_overlaps = m.texel_overlaps != nullptr;
    const std::vector<UvMesh> meshes =
        read_uv_instances(d.instances, d.instance_count, d.instance_stride, [&](uint32_t) {
          return AtlasSize{d.width, d.height};
        });
    check_maps(m, meshes, options.atlas);
    const UvCheck check = check_uv(meshes, options);
    write_maps(check, m);
    write_struct(to_report(check), report);
  });
}
