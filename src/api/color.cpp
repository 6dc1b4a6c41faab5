#include "api/color.h"

#include "api/check.h"
#include "api/desc.h"
#include "api/handles.h"
#include "color/color_spaces.h"

#include <algorithm>

namespace bdpt {

Primaries to_primaries(const bdpt_chromaticities* chromaticities) {
  if (!chromaticities) return kRec709;
  const auto& c = *chromaticities;
  const Primaries primaries{
      {c.red[0], c.red[1]}, {c.green[0], c.green[1]}, {c.blue[0], c.blue[1]}, {c.white[0], c.white[1]}};
  to_xyz(primaries);
  return primaries;
}

bdpt_chromaticities to_chromaticities(const Primaries& primaries) {
  const auto& [r, g, b, w] = primaries;
  return {{r[0], r[1]}, {g[0], g[1]}, {b[0], b[1]}, {w[0], w[1]}};
}

namespace {

void check_colors(const float* rgb, uint64_t count) {
  if (count == 0) return;
  require(rgb, "rgb");
  if (reinterpret_cast<uintptr_t>(rgb) % alignof(float) != 0)
    fail(ErrorCode::InvalidArgument, "rgb is ", rgb, ": align it to 4 bytes");
  constexpr uint64_t kMost = uint64_t(1) << 40;
  if (count > kMost) fail(ErrorCode::InvalidArgument, "count is ", count, ": give at most ", kMost, " colours");
}

}  // namespace
}  // namespace bdpt

using namespace bdpt;

bdpt_result bdpt_color_get_info(const bdpt_context* context, bdpt_color_info* info) {
  return guard(__func__, [&] {
    require(context, "context");
    check_output_struct(info, "info");
    const ColorSpaces& colors = *context->colors;
    const ColorMatrix xyz = to_xyz(colors.primaries());
    bdpt_color_info result{};
    result.rendering_space = colors.rendering_space().c_str();
    result.chromaticities = to_chromaticities(colors.primaries());
    for (int i = 0; i < 3; ++i) result.luminance[i] = static_cast<float>(xyz[i][1]);
    write_struct(result, info);
  });
}

bdpt_result bdpt_color_convert(const bdpt_context* context, const char* from, const char* to, float* rgb,
                               uint64_t count) {
  return guard(__func__, [&] {
    require(context, "context");
    check_colors(rgb, count);
    context->colors->convert(text_or_empty(from), text_or_empty(to), rgb, count);
  });
}

bdpt_result bdpt_color_convert_chromaticities(const bdpt_chromaticities* from, const bdpt_chromaticities* to,
                                              float* rgb, uint64_t count) {
  return guard(__func__, [&] {
    check_colors(rgb, count);
    convert_primaries(to_primaries(from), to_primaries(to), rgb, count);
  });
}
