#include "api/check.h"
#include "api/color.h"
#include "api/desc.h"
#include "api/handles.h"
#include "api/host_array.h"
#include "color/display.h"
#include "io/exr.h"
#include "io/png.h"

#include <string>
#include <vector>

using namespace bdpt;

namespace {

// A stop more or less than these leaves nothing of a float's range.
constexpr double kMaxExposure = 64;
constexpr uint32_t kMaxLayers = 1024;

void check_pixels(const float* pixels, const char* name) {
  require(pixels, name);
  if (reinterpret_cast<uintptr_t>(pixels) % alignof(float) != 0)
    fail(ErrorCode::InvalidArgument, name, " is ", pixels, ": align it to 4 bytes");
}

void check_size(uint32_t width, uint32_t height) {
  for (const auto& [name, value] : {std::pair("width", width), std::pair("height", height)})
    if (value < 1 || value > kMaxImageSide)
      fail(ErrorCode::InvalidArgument, name, " is ", value, ": give 1 to ", kMaxImageSide, " pixels");
}

std::vector<ExrLayer> read_layers(const bdpt_exr_desc& desc) {
  if (desc.layer_count < 1 || desc.layer_count > kMaxLayers)
    fail(ErrorCode::InvalidArgument, "desc.layer_count is ", desc.layer_count, ": give 1 to ", kMaxLayers);
  require(desc.layers, "desc.layers");
  const uint32_t stride = desc.layer_stride ? desc.layer_stride : sizeof(bdpt_image_layer);
  if (stride < sizeof(bdpt_image_layer) || stride % alignof(bdpt_image_layer) != 0)
    fail(ErrorCode::InvalidArgument, "desc.layer_stride is ", stride, ": give sizeof(bdpt_image_layer), or 0");
  std::vector<ExrLayer> layers;
  for (uint32_t i = 0; i < desc.layer_count; ++i) {
    const bdpt_image_layer& layer = element(desc.layers, i, stride);
    check_pixels(layer.pixels, ("desc.layers[" + std::to_string(i) + "].pixels").c_str());
    layers.push_back({text_or_empty(layer.name), layer.pixels});
  }
  return layers;
}

}  // namespace

bdpt_result bdpt_image_display(const bdpt_display_desc* desc, float* pixels, uint32_t width, uint32_t height) {
  return guard(__func__, [&] {
    const bdpt_display_desc d = read_optional_struct(desc, "desc");
    const Subject subject("desc", nullptr);
    subject.check_enum("view", d.view, BDPT_VIEW_OCIO);
    subject.check_range("exposure", d.exposure, -kMaxExposure, kMaxExposure);
    subject.check_reserved("reserved", d.reserved);
    check_pixels(pixels, "pixels");
    check_size(width, height);
    const DisplayOptions options{static_cast<DisplayView>(d.view),
                                 d.exposure,
                                 d.context ? d.context->colors.get() : nullptr,
                                 text_or_empty(d.config),
                                 text_or_empty(d.color_space),
                                 text_or_empty(d.display),
                                 text_or_empty(d.ocio_view)};
    to_display(options, pixels, width, height);
  });
}

bdpt_result bdpt_image_write_exr(const char* path, const bdpt_exr_desc* desc) {
  return guard(__func__, [&] {
    check_path(path);
    const bdpt_exr_desc d = read_struct(desc, "desc");
    check_size(d.width, d.height);
    Subject("desc", nullptr).check_flag("half", d.half);
    const Primaries primaries = to_primaries(d.chromaticities);
    write_exr(path, d.width, d.height, read_layers(d), d.half != 0,
              {primaries.red, primaries.green, primaries.blue, primaries.white});
  });
}

bdpt_result bdpt_image_write_png(const char* path, const float* pixels, uint32_t width, uint32_t height) {
  return guard(__func__, [&] {
    check_path(path);
    check_pixels(pixels, "pixels");
    check_size(width, height);
    write_png(path, pixels, width, height);
  });
}
