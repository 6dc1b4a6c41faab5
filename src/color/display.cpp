#include "color/display.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/error.h"
#include "color/close_names.h"
#include "color/color_spaces.h"
#include "color/config.h"
#include "color/primaries.h"
#include "color/standard_spaces.h"

namespace bdpt {
namespace {

// Beyond it no display transform makes a difference, and its arithmetic could overflow.
constexpr float kLargest = 65504.0f;

ocio::ConstTransformRcPtr builtin(const char* style, ocio::TransformDirection direction) {
  const ocio::BuiltinTransformRcPtr transform = ocio::BuiltinTransform::Create();
  transform->setStyle(style);
  transform->setDirection(direction);
  return transform;
}

ocio::ConstTransformRcPtr srgb_view() {
  const ocio::ExponentWithLinearTransformRcPtr curve = ocio::ExponentWithLinearTransform::Create();
  curve->setGamma({2.4, 2.4, 2.4, 1.0});
  curve->setOffset({0.055, 0.055, 0.055, 0.0});
  curve->setDirection(ocio::TRANSFORM_DIR_INVERSE);
  return curve;
}

ocio::ConstTransformRcPtr aces_view() {
  const ocio::GroupTransformRcPtr group = ocio::GroupTransform::Create();
  const auto append = [&](const char* style, ocio::TransformDirection direction) {
    group->appendTransform(std::const_pointer_cast<ocio::Transform>(builtin(style, direction)));
  };
  append("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD", ocio::TRANSFORM_DIR_INVERSE);
  append("ACEScg_to_ACES2065-1", ocio::TRANSFORM_DIR_FORWARD);
  append("ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0", ocio::TRANSFORM_DIR_FORWARD);
  append("DISPLAY - CIE-XYZ-D65_to_sRGB", ocio::TRANSFORM_DIR_FORWARD);
  return group;
}

// Fails: the configuration has no such thing; it has these.
template <class Name>
[[noreturn]] void fail_absent(const Config& config, const std::string& kind, const std::string& name, int count,
                              const Name& name_of) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.emplace_back(name_of(i));
  fail(ErrorCode::InvalidArgument, "configuration '", config.path(), "' has no ", kind, " '", name,
       "': ", suggestions(name, names));
}

// How the pixels come to be in a space that the configuration has.
struct Source {
  const char* standard;  // a space that they are converted to first, or NULL
  ColorMatrix matrix;
  std::string space;
};

Source source(const DisplayOptions& options, const Config& config) {
  if (options.color_space.empty() && options.spaces) {
    const std::string& rendering = options.spaces->rendering_space();
    if (&config == options.spaces->config() && config.has(rendering)) return {nullptr, {}, rendering};
    const Config::Join join = config.join();
    return {kAces2065, conversion(kAp0, join.primaries), join.space};
  }
  const std::string named = options.color_space.empty() ? ocio::ROLE_SCENE_LINEAR : options.color_space;
  if (config.has(named)) return {nullptr, {}, named};
  const std::vector<std::string> spaces = config.spaces();
  fail_absent(config, options.color_space.empty() ? "role" : "color space", named, static_cast<int>(spaces.size()),
              [&](int i) { return spaces[static_cast<size_t>(i)]; });
}

ocio::ConstTransformRcPtr config_view(const DisplayOptions& options, const Config& file, const std::string& space) {
  const ocio::Config& config = file.get();
  const std::string display = options.display.empty() ? config.getDefaultDisplay() : options.display;
  bool found = false;
  for (int i = 0; i < config.getNumDisplaysAll(); ++i) found |= display == config.getDisplayAll(i);
  if (!found)
    fail_absent(file, "display", display, config.getNumDisplays(), [&](int i) { return config.getDisplay(i); });

  const std::string view = options.ocio_view.empty() ? config.getDefaultView(display.c_str()) : options.ocio_view;
  const char* view_space = config.getDisplayViewColorSpaceName(display.c_str(), view.c_str());
  if (!view_space || !*view_space)
    fail_absent(file, "display '" + display + "' with a view", view, config.getNumViews(display.c_str()),
                [&](int i) { return config.getView(display.c_str(), i); });

  const ocio::DisplayViewTransformRcPtr transform = ocio::DisplayViewTransform::Create();
  transform->setSrc(space.c_str());
  transform->setDisplay(display.c_str());
  transform->setView(view.c_str());
  return transform;
}

ocio::ConstTransformRcPtr matrix_transform(const ColorMatrix& matrix) {
  double columns[16] = {};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) columns[4 * j + i] = matrix[i][j];
  columns[15] = 1;
  const ocio::MatrixTransformRcPtr transform = ocio::MatrixTransform::Create();
  transform->setMatrix(columns);
  return transform;
}

// A view, and the standard space that it takes its pixels in; NULL where they are as it takes them.
struct View {
  const char* standard;
  ocio::ConstCPUProcessorRcPtr processor;
};

View make_view(const ocio::Config& config, const char* standard, const ocio::ConstTransformRcPtr& transform) {
  return {standard, config.getProcessor(transform)->getOptimizedCPUProcessor(kOptimization)};
}

View ocio_view(const DisplayOptions& options) {
  std::optional<const Config> named;
  if (!options.config.empty()) named.emplace(options.config);
  const Config* config = named ? &*named : options.spaces ? options.spaces->config() : nullptr;
  if (!config)
    fail(ErrorCode::InvalidArgument,
         "no configuration: give the path of one; the environment variable OCIO is not read");
  const auto [standard, matrix, space] = source(options, *config);
  const ocio::GroupTransformRcPtr group = ocio::GroupTransform::Create();
  for (const ocio::ConstTransformRcPtr& step : {matrix_transform(matrix), config_view(options, *config, space)})
    group->appendTransform(std::const_pointer_cast<ocio::Transform>(step));
  return make_view(config->get(), standard, group);
}

View find_view(const DisplayOptions& options) {
  switch (options.view) {
    case DisplayView::Srgb:
      return make_view(*ocio::Config::CreateRaw(), kLinearRec709, srgb_view());
    case DisplayView::Aces:
      return make_view(*ocio::Config::CreateRaw(), kLinearRec709, aces_view());
    case DisplayView::Ocio:
      return ocio_view(options);
  }
  fail(ErrorCode::InvalidArgument, "view ", static_cast<int>(options.view), " is unknown");
}

// A number in range for any float.
float sanitized(float value, float lowest, float highest) {
  return std::isnan(value) ? 0.0f : std::clamp(value, lowest, highest);
}

}  // namespace

void to_display(const DisplayOptions& options, float* pixels, uint32_t width, uint32_t height) {
  if (!std::isfinite(options.exposure))
    fail(ErrorCode::InvalidArgument, "exposure is ", options.exposure, ", which is not finite");
  if (!pixels || width < 1 || height < 1)
    fail(ErrorCode::InvalidArgument, "there is no image: ", width, " x ", height, " pixels");
  try {
    const View view = find_view(options);
    const bool convert = view.standard && options.spaces;
    if (convert) options.spaces->convert({}, view.standard, nullptr, 0);  // fails while nothing has changed
    const float scale = std::exp2(options.exposure);
    const size_t count = size_t{3} * width * height;
    for (size_t i = 0; i < count; ++i) pixels[i] = sanitized(pixels[i] * scale, -kLargest, kLargest);
    if (convert) options.spaces->convert({}, view.standard, pixels, count / 3);
    ocio::PackedImageDesc image(pixels, width, height, 3);
    view.processor->apply(image);
    for (size_t i = 0; i < count; ++i) pixels[i] = sanitized(pixels[i], 0.0f, 1.0f);
  } catch (const ocio::ExceptionMissingFile& error) {
    fail(ErrorCode::Io, error.what());
  } catch (const ocio::Exception& error) {
    fail(ErrorCode::InvalidArgument, error.what());
  }
}

}  // namespace bdpt
