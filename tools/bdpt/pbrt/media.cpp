// SPDX-License-Identifier: Apache-2.0
#include "pbrt/media.h"

namespace bdpt_tool {

MediumDescription convert_medium(const std::string& name, const ParamList& params, Diagnostics& diagnostics) {
  const std::string type = params.get_string("type", "");
  if (type.empty()) params.fail("\"string type\" is missing");
  if (type != "homogeneous") params.fail("the medium '" + type + "' is not known; use homogeneous");
  params.refuse("preset", "is not known; give \"rgb sigma_a\" and \"rgb sigma_s\"");
  params.refuse("Le", "is not known: media do not shine");
  params.ignore("Lescale");
  MediumDescription medium;
  medium.label = name;
  medium.where = params.where();
  medium.sigma_a = params.get_rgb("sigma_a", {0.0011f, 0.0024f, 0.014f});
  medium.sigma_s = params.get_rgb("sigma_s", {2.55f, 3.21f, 3.77f});
  medium.g = params.get_float("g", 0);
  const float scale = params.get_float("scale", 1);
  for (Rgb* sigma : {&medium.sigma_a, &medium.sigma_s}) {
    for (float& x : *sigma) {
      x *= scale;
      if (!(x >= 0)) params.fail("sigma_a, sigma_s and scale must not be negative");
    }
  }
  if (!(medium.g > -1 && medium.g < 1)) params.fail("g must be between -1 and 1");
  params.warn_unused(diagnostics);
  return medium;
}

}  // namespace bdpt_tool
