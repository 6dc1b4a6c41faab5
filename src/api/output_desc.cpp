#include "api/output_desc.h"

#include "api/host_array.h"
#include "film/film.h"

namespace bdpt {

namespace {

constexpr uint32_t kMostTexels = 32, kUsualTexels = 8;  // along a side

void read_size(const Subject& subject, const bdpt_output_desc& desc, OutputDesc& output) {
  if (desc.unfiltered != 0)
    subject.refuse("unfiltered", "is ", desc.unfiltered, ", and the sensor is no camera: give 0");
  subject.check_range("size", desc.size, 0, kMostTexels);
  if (is_octahedral(output.kind)) {
    output.size = int(desc.size == 0 ? kUsualTexels : desc.size);
  } else if (desc.size != 0) {
    subject.refuse("size", "is ", desc.size, ", and the output is no octahedral one: give 0");
  }
  if (output.kind == OutputKind::DistanceOctahedral && desc.reach == 0)
    subject.refuse("reach", "is 0: give the distance that stands for all that is farther");
}

}  // namespace

std::vector<OutputDesc> read_outputs(const Subject& sensor, const bdpt_output_desc* outputs, uint32_t count,
                                     uint32_t stride, OutputKind otherwise) {
  if (count == 0) return {OutputDesc{otherwise}};
  require(outputs, "outputs");
  check_stride(sensor, "output_stride", stride, kVersion1Size<bdpt_output_desc>, 8);
  if (stride == 0) stride = outputs->struct_size;  // the caller's, whatever this library's is
  std::vector<OutputDesc> result;
  int planes = 0;
  for (uint32_t i = 0; i < count && planes <= kMaxPlanes; ++i) {
    const std::string name = "output " + std::to_string(i);
    const Subject subject(name.c_str(), nullptr);
    const bdpt_output_desc d = read_struct(&element(outputs, i, stride), name.c_str());
    if (d.kind >= BDPT_OUTPUT_RADIANCE && d.kind <= BDPT_OUTPUT_MATERIAL_COVERAGE)
      subject.refuse("kind", "is ", d.kind, ", an output of cameras: ask for 0 to ", BDPT_OUTPUT_UNSHADOWED);
    subject.check_enum("kind", d.kind, BDPT_OUTPUT_UNSHADOWED);
    subject.check_enum("paths", d.paths, BDPT_LIGHT_PATHS_INDIRECT);
    subject.check_not_negative("reach", &d.reach, 1);
    OutputDesc output;
    output.kind = static_cast<OutputKind>(d.kind);
    output.direct = d.paths != BDPT_LIGHT_PATHS_INDIRECT;
    output.indirect = d.paths != BDPT_LIGHT_PATHS_DIRECT;
    if (d.groups != 0) output.groups = d.groups;
    output.reach = d.reach;
    read_size(subject, d, output);
    planes += Outputs::planes_of(output);
    result.push_back(output);
  }
  if (planes > kMaxPlanes)
    fail(ErrorCode::InvalidArgument, "outputs need more than ", kMaxPlanes, " planes: bake them in several sensors");
  return result;
}

}  // namespace bdpt
