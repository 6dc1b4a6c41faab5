#include "api/output_desc.h"

#include "api/host_array.h"
#include "film/film.h"

namespace bdpt {

std::vector<OutputDesc> read_outputs(const Subject& sensor, const bdpt_output_desc* outputs, uint32_t count,
                                     uint32_t stride, OutputKind otherwise) {
  if (count == 0) return {OutputDesc{otherwise}};
  require(outputs, "outputs");
  check_stride(sensor, "output_stride", stride, kVersion1Size<bdpt_output_desc>, 8);
  std::vector<OutputDesc> result;
  int planes = 0;
  for (uint32_t i = 0; i < count && planes <= kMaxPlanes; ++i) {
    const std::string name = "output " + std::to_string(i);
    const Subject subject(name.c_str(), nullptr);
    const bdpt_output_desc d = read_struct(&element(outputs, i, stride), name.c_str());
    subject.check_enum("kind", d.kind, BDPT_OUTPUT_UNSHADOWED);
    subject.check_enum("paths", d.paths, BDPT_LIGHT_PATHS_INDIRECT);
    subject.check_not_negative("reach", &d.reach, 1);
    OutputDesc output;
    output.kind = static_cast<OutputKind>(d.kind);
    output.direct = d.paths != BDPT_LIGHT_PATHS_INDIRECT;
    output.indirect = d.paths != BDPT_LIGHT_PATHS_DIRECT;
    if (d.groups != 0) output.groups = d.groups;
    output.reach = d.reach;
    planes += Outputs::planes_of(output.kind);
    result.push_back(output);
  }
  if (planes > kMaxPlanes)
    fail(ErrorCode::InvalidArgument, "outputs need more than ", kMaxPlanes, " planes: bake them in several sensors");
  return result;
}

}  // namespace bdpt
