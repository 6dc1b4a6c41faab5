#include "api/camera_outputs.h"

#include "api/host_array.h"
#include "film/film.h"

#include <iterator>

namespace bdpt {

namespace {

constexpr uint32_t kMaxOutputs = kMaxCameraPlanes - 1;

constexpr Seen kSeen[] = {Seen::Light,    Seen::Albedo,   Seen::Normal,  Seen::Depth,
                          Seen::Position, Seen::Instance, Seen::Material};
static_assert(std::size(kSeen) == BDPT_OUTPUT_MATERIAL_COVERAGE - BDPT_OUTPUT_RADIANCE + 1);

OutputPlanes read_output(const Subject& subject, const bdpt_output_desc& desc) {
  if (desc.kind < BDPT_OUTPUT_RADIANCE || desc.kind > BDPT_OUTPUT_MATERIAL_COVERAGE)
    subject.refuse("kind", "is ", desc.kind, ": a camera measures kinds ", BDPT_OUTPUT_RADIANCE, " to ",
                   BDPT_OUTPUT_MATERIAL_COVERAGE);
  subject.check_enum("paths", desc.paths, BDPT_LIGHT_PATHS_INDIRECT);
  subject.check_flag("unfiltered", desc.unfiltered);
  OutputPlanes output;
  output.kind = desc.kind;
  output.seen = kSeen[desc.kind - BDPT_OUTPUT_RADIANCE];
  const auto check_unused = [&](const char* field, bool is_set, const char* whose) {
    if (is_set)
      subject.refuse(field, "means nothing to an output of kind ", desc.kind, ", only to ", whose, ": give 0");
  };
  check_unused("reach", desc.reach != 0, "openness and distances");
  check_unused("size", desc.size != 0, "octahedral ones");
  if (output.seen != Seen::Light) {
    check_unused("paths", desc.paths != BDPT_LIGHT_PATHS_ALL, "light");
    check_unused("groups", desc.groups != 0, "light");
  }
  if (is_coverage(output.seen)) check_unused("unfiltered", desc.unfiltered != 0, "planes");
  output.direct = desc.paths != BDPT_LIGHT_PATHS_INDIRECT;
  output.indirect = desc.paths != BDPT_LIGHT_PATHS_DIRECT;
  output.direct_edges = 2;
  if (desc.groups != 0) output.groups = desc.groups;
  output.unfiltered = desc.unfiltered != 0;
  return output;
}

}  // namespace

std::vector<OutputPlanes> read_camera_outputs(const Subject& camera, const bdpt_camera_desc& desc) {
  std::vector<OutputPlanes> result{OutputPlanes{}};
  if (desc.output_count == 0) return result;
  camera.check_range("output_count", desc.output_count, 0, kMaxOutputs);
  require(desc.outputs, "desc.outputs");
  check_stride(camera, "output_stride", desc.output_stride, kVersion1Size<bdpt_output_desc>, 8);
  const uint32_t stride = desc.output_stride ? desc.output_stride : desc.outputs->struct_size;
  int planes = 1, coverages = 0;
  for (uint32_t i = 0; i < desc.output_count; ++i) {
    const std::string name = "output " + std::to_string(i);
    const Subject subject(name.c_str(), nullptr);
    OutputPlanes output = read_output(subject, read_struct(&element(desc.outputs, i, stride), name.c_str()));
    if (is_coverage(output.seen)) {
      for (const OutputPlanes& o : result)
        if (o.seen == output.seen) subject.refuse("kind", "is ", output.kind, " once more: ask for it once");
      output.first = coverages++;
      output.count = 0;
    } else {
      output.first = planes++;
    }
    result.push_back(output);
  }
  return result;
}

}  // namespace bdpt
