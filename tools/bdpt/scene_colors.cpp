// SPDX-License-Identifier: Apache-2.0
#include "scene_colors.h"

#include <algorithm>
#include <cmath>

#include "handles.h"

namespace bdpt_tool {
namespace {

class ColorConverter {
 public:
  explicit ColorConverter(const bdpt_context* context) : context_(context) {}

  void convert(Rgb& color) const {
    check(bdpt_color_convert(context_, kSceneSpace, nullptr, color.data(), 1), "the colours of the scene");
  }

  // What may not be negative: a space smaller than Rec. 709 has no such colour, and takes the nearest.
  void convert_to_light(Rgb& color) const {
    const Rgb before = color;
    convert(color);
    if (color == before) return;  // what a scene may not say is the library's to refuse
    for (float& channel : color) channel = std::max(channel, 0.0f);
  }

  // Reflectances, too, keep to [0, 1]: a rounding of the matrix may lead beyond.
  void convert_to_reflectance(Rgb& color) const {
    const Rgb before = color;
    convert(color);
    if (color == before) return;
    for (float& channel : color) channel = std::clamp(channel, 0.0f, 1.0f);
  }

  // An index of refraction is no colour, but the reflectance at normal incidence is: k becomes what brings it about,
  // and where it would have to be imaginary, eta does too.
  void convert_metal(Rgb& eta, Rgb& k) const {
    Rgb color = {};
    for (std::size_t c = 0; c < 3; ++c) color[c] = reflectance(eta[c], k[c]);
    const Rgb before = color;
    convert_to_reflectance(color);
    if (color == before) return;
    for (std::size_t c = 0; c < 3; ++c) {
      const float r = std::min(color[c], 0.9999f);
      const float square = (r * (eta[c] + 1) * (eta[c] + 1) - (eta[c] - 1) * (eta[c] - 1)) / (1 - r);
      k[c] = std::sqrt(std::max(square, 0.0f));
      if (square < 0) eta[c] = (1 + std::sqrt(r)) / (1 - std::sqrt(r));
    }
  }

 private:
  static constexpr const char* kSceneSpace = "lin_rec709";

  static float reflectance(float eta, float k) {
    return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
  }

  const bdpt_context* context_;
};

}  // namespace

void convert_colors(const bdpt_context* context, SceneDescription& description) {
  const ColorConverter converter(context);
  for (MaterialDescription& material : description.materials) {
    converter.convert_to_reflectance(material.reflectance);
    converter.convert_to_reflectance(material.transmittance.factor);
    converter.convert_to_reflectance(material.principled.specular_color.factor);
    converter.convert_to_reflectance(material.principled.sheen_color.factor);
    converter.convert_to_reflectance(material.principled.attenuation_color);
    converter.convert_to_light(material.emission);
    if (material.type == BDPT_MATERIAL_CONDUCTOR || material.type == BDPT_MATERIAL_COATED_CONDUCTOR)
      converter.convert_metal(material.eta, material.k);
  }
  for (MediumDescription& medium : description.media) {
    converter.convert_to_light(medium.sigma_a);
    converter.convert_to_light(medium.sigma_s);
  }
  for (LightDescription& light : description.lights) converter.convert_to_light(light.value);
}

}  // namespace bdpt_tool
