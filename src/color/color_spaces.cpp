#include "color/color_spaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>

#include "base/error.h"
#include "color/close_names.h"
#include "color/config.h"
#include "color/standard_spaces.h"
#include "math/srgb.h"

namespace bdpt {
namespace {

// Two matrices that differ by no more are one: configurations write six to twelve digits.
constexpr double kSameMatrix = 1e-4;

void multiply(const ColorMatrix& matrix, float* rgb, size_t count) {
  float m[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[i][j] = static_cast<float>(matrix[i][j]);
  for (float* c = rgb; c != rgb + 3 * count; c += 3) {
    const float r = c[0], g = c[1], b = c[2];
    for (int j = 0; j < 3; ++j) c[j] = r * m[0][j] + g * m[1][j] + b * m[2][j];
  }
}

void apply(const ocio::CPUProcessor& processor, float* rgb, size_t count) {
  ocio::PackedImageDesc image(rgb, static_cast<long>(count), 1, 3);
  processor.apply(image);
}

}  // namespace

// The steps of a conversion, in order; most have one or two.
struct Conversion {
  ocio::ConstCPUProcessorRcPtr before;  // in the configuration
  bool from_srgb = false;
  ColorMatrix matrix;
  bool to_srgb = false;
  ocio::ConstCPUProcessorRcPtr after;  // in the configuration

  bool has_matrix() const { return matrix != ColorMatrix(); }
  bool is_identity() const {
    return !(before && !before->isNoOp()) && !from_srgb && !has_matrix() && !to_srgb && !(after && !after->isNoOp());
  }
  void run(float* rgb, size_t count) const {
    if (before) apply(*before, rgb, count);
    if (from_srgb) std::transform(rgb, rgb + 3 * count, rgb, srgb_to_linear);
    if (has_matrix()) multiply(matrix, rgb, count);
    if (to_srgb) std::transform(rgb, rgb + 3 * count, rgb, linear_to_srgb);
    if (after) apply(*after, rgb, count);
  }
};

// A space of the configuration, or a standard one.
struct Space {
  std::string in_config;
  const StandardSpace* standard = nullptr;
};

namespace {

// The matrix by which a conversion works; empty where it does not work by one.
std::optional<ColorMatrix> matrix_of(const Conversion& conversion) {
  ColorMatrix matrix;
  for (int i = 0; i < 3; ++i) {
    float rgb[3] = {};
    rgb[i] = 1;
    conversion.run(rgb, 1);
    for (int j = 0; j < 3; ++j) matrix[i][j] = rgb[j];
  }
  for (const Imath::V3d& color : {Imath::V3d(0, 0, 0), Imath::V3d(0.18, 0.18, 0.18), Imath::V3d(0.5, 0.2, 0.01),
                                  Imath::V3d(0.05, 4, 0.3), Imath::V3d(100, 20, 300)}) {
    float rgb[3] = {static_cast<float>(color.x), static_cast<float>(color.y), static_cast<float>(color.z)};
    conversion.run(rgb, 1);
    const Imath::V3d expected = color * matrix;
    for (int j = 0; j < 3; ++j)
      if (!(std::abs(rgb[j] - expected[j]) <= 1e-3 * color.length())) return {};
  }
  return matrix;
}

bool same(const ColorMatrix& a, const ColorMatrix& b) { return a.equalWithAbsError(b, kSameMatrix); }

}  // namespace

struct ColorSpaces::Impl {
  std::unique_ptr<const Config> config;
  std::string rendering_space = kLinearRec709;
  Space rendering{{}, find_standard_space(kLinearRec709)};
  Primaries primaries = kRec709;
  bool is_standard = true;  // a linear standard space, by name or by its matrix
  mutable std::mutex mutex;
  mutable std::map<std::pair<std::string, std::string>, std::shared_ptr<const Conversion>> conversions;

  Space find(const std::string& name) const {
    if (name.empty()) return rendering;
    if (config && config->has(name)) return {name, nullptr};
    if (const StandardSpace* standard = find_standard_space(name)) return {{}, standard};
    std::vector<std::string> known = config ? config->spaces() : std::vector<std::string>();
    for (const StandardSpace& space : standard_spaces())
      if (std::find(known.begin(), known.end(), space.name()) == known.end()) known.emplace_back(space.name());
    fail(ErrorCode::InvalidArgument, "color space '", name, "' is unknown",
         config ? " to configuration '" + config->path() + "'" : ", and there is no configuration", ": ",
         suggestions(name, known));
  }

  Conversion make(const Space& from, const Space& to) const {
    Conversion result;
    if (from.standard && from.standard == to.standard) return result;
    const auto is_data = [&](const Space& space) {
      return space.standard ? space.standard->curve == Curve::Data : config->is_data(space.in_config);
    };
    if (is_data(from) || is_data(to)) return result;
    if (!from.standard && !to.standard) {
      result.before = config->processor(from.in_config, to.in_config);
      return result;
    }
    Primaries source{}, target{};
    if (from.standard) {
      source = from.standard->primaries;
      result.from_srgb = from.standard->curve == Curve::Srgb;
    } else {
      const Config::Join join = config->join();
      source = join.primaries;
      result.before = config->processor(from.in_config, join.space);
    }
    if (to.standard) {
      target = to.standard->primaries;
      result.to_srgb = to.standard->curve == Curve::Srgb;
    } else {
      const Config::Join join = config->join();
      target = join.primaries;
      result.after = config->processor(join.space, to.in_config);
    }
    result.matrix = conversion(source, target);
    return result;
  }

  std::shared_ptr<const Conversion> conversion_between(const std::string& from, const std::string& to) const {
    const std::lock_guard lock(mutex);
    const auto found = conversions.find({from, to});
    if (found != conversions.end()) return found->second;
    auto made = std::make_shared<const Conversion>(make(find(from), find(to)));
    conversions.emplace(std::pair(from, to), made);
    return made;
  }

  void choose_rendering_space(const std::string& name) {
    const auto refuse = [&](const auto&... parts) {
      fail(ErrorCode::InvalidArgument, "rendering space '", name, "' ", parts...);
    };
    rendering = find(name);
    rendering_space = name;
    if (rendering.standard) {
      if (rendering.standard->curve != Curve::Linear)
        refuse("is not linear: light adds up in linear spaces alone, such as '", kLinearRec709, "' or 'ACEScg'");
      primaries = rendering.standard->primaries;
      return;
    }
    if (config->is_data(name)) refuse("is for data: its numbers are no colours. Give a linear space, such as 'ACEScg'");
    const Config::Join join = config->join();
    Conversion to_join;
    to_join.before = config->processor(name, join.space);
    const std::optional<ColorMatrix> matrix = matrix_of(to_join);
    if (!matrix)
      refuse("is not linear: light adds up in linear spaces alone. Give the scene-linear one of '", config->path(),
             "'");
    if (!(std::abs(matrix->determinant()) > 1e-9)) refuse("cannot be inverted: some of its colours are the same");
    config->processor(join.space, name);  // fails where there is no way back
    primaries = primaries_by(*matrix, join.primaries);
    to_xyz(primaries);  // fails where no light has these colours
  }

  // The published primaries where the matrix is theirs; else those seen at the white of D65.
  Primaries primaries_by(const ColorMatrix& matrix, const Primaries& join) {
    for (const StandardSpace& space : standard_spaces())
      if (space.curve == Curve::Linear && same(matrix, conversion(space.primaries, join))) return space.primaries;
    is_standard = false;
    return primaries_of(matrix * conversion(join, kRec709) * to_xyz(kRec709));
  }
};

ColorSpaces::ColorSpaces(const std::string& config, const std::string& rendering_space)
    : impl_(std::make_unique<Impl>()) {
  if (!config.empty()) impl_->config = std::make_unique<const Config>(config);
  if (!rendering_space.empty()) impl_->choose_rendering_space(rendering_space);
}

ColorSpaces::~ColorSpaces() = default;

void ColorSpaces::convert(const std::string& from, const std::string& to, float* rgb, size_t count) const {
  const std::shared_ptr<const Conversion> conversion = impl_->conversion_between(from, to);
  if (count > 0) conversion->run(rgb, count);
}

bool ColorSpaces::is_identity(const std::string& from, const std::string& to) const {
  return impl_->conversion_between(from, to)->is_identity();
}

const std::string& ColorSpaces::rendering_space() const { return impl_->rendering_space; }
bool ColorSpaces::renders_in_rec709() const { return impl_->is_standard && impl_->primaries == kRec709; }
const Primaries& ColorSpaces::primaries() const { return impl_->primaries; }
const Config* ColorSpaces::config() const { return impl_->config.get(); }

void convert_primaries(const Primaries& from, const Primaries& to, float* rgb, size_t count) {
  const ColorMatrix matrix = conversion(from, to);
  if (matrix != ColorMatrix()) multiply(matrix, rgb, count);
}

}  // namespace bdpt
