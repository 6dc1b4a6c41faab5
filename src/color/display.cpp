#include "color/display.h"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <vector>

#include "base/error.h"

namespace bdpt {
namespace {

namespace ocio = OCIO_NAMESPACE;

// Beyond it no display transform makes a difference, and its arithmetic could overflow.
constexpr float kLargest = 65504.0f;

// Exact, but for inverse tables, whose exact form is out of proportion.
constexpr auto kOptimization =
    static_cast<ocio::OptimizationFlags>(ocio::OPTIMIZATION_LOSSLESS | ocio::OPTIMIZATION_LUT_INV_FAST);

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
[[noreturn]] void fail_absent(const std::string& config, const char* kind, const std::string& name, int count,
                              const Name& name_of) {
  constexpr int kMost = 24;
  std::ostringstream names;
  for (int i = 0; i < std::min(count, kMost); ++i) names << (i ? ", '" : "'") << name_of(i) << "'";
  if (count > kMost) names << " and " << count - kMost << " more";
  fail(ErrorCode::InvalidArgument, "configuration '", config, "' has no ", kind, " '", name, "'; it has ",
       count ? names.str() : "none");
}

ocio::ConstConfigRcPtr read_config(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) error = std::make_error_code(std::errc::is_a_directory);
  if (!error && !std::ifstream(path)) error.assign(errno, std::generic_category());
  if (error) fail(ErrorCode::Io, "cannot read configuration '", path, "': ", error.message());
  try {
    return ocio::Config::CreateFromFile(path.c_str());
  } catch (const ocio::Exception& e) {
    fail(ErrorCode::Format, "configuration '", path, "' is damaged: ", e.what());
  }
}

ocio::ConstTransformRcPtr config_view(const DisplayOptions& options, const std::string& path,
                                      const ocio::Config& config) {
  const std::string space = options.color_space.empty() ? ocio::ROLE_SCENE_LINEAR : options.color_space;
  if (!config.getColorSpace(space.c_str()))
    fail_absent(path, options.color_space.empty() ? "role" : "color space", space, config.getNumColorSpaces(),
                [&](int i) { return config.getColorSpaceNameByIndex(i); });

  const std::string display = options.display.empty() ? config.getDefaultDisplay() : options.display;
  bool found = false;
  for (int i = 0; i < config.getNumDisplaysAll(); ++i) found |= display == config.getDisplayAll(i);
  if (!found)
    fail_absent(path, "display", display, config.getNumDisplays(), [&](int i) { return config.getDisplay(i); });

  const std::string view = options.ocio_view.empty() ? config.getDefaultView(display.c_str()) : options.ocio_view;
  const char* view_space = config.getDisplayViewColorSpaceName(display.c_str(), view.c_str());
  if (!view_space || !*view_space)
    fail_absent(path, ("display '" + display + "' with a view").c_str(), view, config.getNumViews(display.c_str()),
                [&](int i) { return config.getView(display.c_str(), i); });

  const ocio::DisplayViewTransformRcPtr transform = ocio::DisplayViewTransform::Create();
  transform->setSrc(space.c_str());
  transform->setDisplay(display.c_str());
  transform->setView(view.c_str());
  return transform;
}

ocio::ConstCPUProcessorRcPtr processor(const DisplayOptions& options) {
  ocio::ConstConfigRcPtr config;
  ocio::ConstTransformRcPtr transform;
  switch (options.view) {
    case DisplayView::Srgb:
      config = ocio::Config::CreateRaw();
      transform = srgb_view();
      break;
    case DisplayView::Aces:
      config = ocio::Config::CreateRaw();
      transform = aces_view();
      break;
    case DisplayView::Ocio: {
      const char* variable = std::getenv("OCIO");
      const std::string path = !options.config.empty() ? options.config : variable ? variable : "";
      if (path.empty())
        fail(ErrorCode::InvalidArgument, "no configuration: none is given and the environment variable OCIO is empty");
      config = read_config(path);
      transform = config_view(options, path, *config);
      break;
    }
  }
  if (!transform) fail(ErrorCode::InvalidArgument, "view ", static_cast<int>(options.view), " is unknown");
  return config->getProcessor(transform)->getOptimizedCPUProcessor(kOptimization);
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
    const ocio::ConstCPUProcessorRcPtr cpu = processor(options);
    const float scale = std::exp2(options.exposure);
    const size_t count = size_t{3} * width * height;
    for (size_t i = 0; i < count; ++i) pixels[i] = sanitized(pixels[i] * scale, -kLargest, kLargest);
    ocio::PackedImageDesc image(pixels, width, height, 3);
    cpu->apply(image);
    for (size_t i = 0; i < count; ++i) pixels[i] = sanitized(pixels[i], 0.0f, 1.0f);
  } catch (const ocio::ExceptionMissingFile& error) {
    fail(ErrorCode::Io, error.what());
  } catch (const ocio::Exception& error) {
    fail(ErrorCode::InvalidArgument, error.what());
  }
}

}  // namespace bdpt
