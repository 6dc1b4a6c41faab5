// SPDX-License-Identifier: Apache-2.0
#include "image_chromaticities.h"

#include <ImfChromaticities.h>
#include <ImfStandardAttributes.h>

#include <stdexcept>

#include "bdpt.h"

namespace bdpt_tool::detail {

void convert_to_rec709(const Imf::Header& header, std::map<std::string, Image>& layers) {
  const auto main = layers.find("");
  if (!Imf::hasChromaticities(header) || main == layers.end()) return;
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  if (c == Imf::Chromaticities()) return;  // Rec. 709, its default
  const bdpt_chromaticities from = {
      {c.red.x, c.red.y}, {c.green.x, c.green.y}, {c.blue.x, c.blue.y}, {c.white.x, c.white.y}};
  std::vector<float>& pixels = main->second.pixels;
  if (bdpt_color_convert_chromaticities(&from, nullptr, pixels.data(), pixels.size() / 3) < 0) {
    throw std::runtime_error(std::string("its chromaticities: ") + bdpt_last_error());
  }
  layers.erase("variance");
}

}  // namespace bdpt_tool::detail
