#include "api/desc.h"
#include "api/handles.h"

using namespace bdpt;

bdpt_result bdpt_sensor_get_plane(const bdpt_sensor* sensor, uint32_t plane, bdpt_plane_info* info) {
  return guard(__func__, [&] {
    const Sensor& s = *require(sensor, "sensor").sensor;
    check_output_struct(info, "info");
    if (plane >= uint32_t(s.planes()))
      fail(ErrorCode::InvalidArgument, "plane is ", plane, ": the sensor has ", s.planes(), " planes");
    bdpt_plane_info result{};
    for (const OutputPlanes& o : s.outputs()) {
      if (o.count == 0 || plane >= uint32_t(o.first + o.count)) {
        ++result.output;
        continue;
      }
      if (!s.is_local() && result.output > 0) --result.output;  // the picture comes first
      result.kind = o.kind < 0 ? BDPT_OUTPUT_NONE : o.kind;
      result.coefficient = plane - uint32_t(o.first);
      result.paths = o.indirect ? o.direct ? BDPT_LIGHT_PATHS_ALL : BDPT_LIGHT_PATHS_INDIRECT : BDPT_LIGHT_PATHS_DIRECT;
      result.reach = o.seen == Seen::Openness && o.reach < 3e38f ? o.reach : 0;
      if (o.seen == Seen::Unshadowed) result.paths = BDPT_LIGHT_PATHS_DIRECT;
      result.groups = o.seen == Seen::Light || o.seen == Seen::Unshadowed ? o.groups : 0;
      break;
    }
    write_struct(result, info);
  });
}
