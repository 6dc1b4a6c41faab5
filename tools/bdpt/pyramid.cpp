// SPDX-License-Identifier: Apache-2.0
#include "pyramid.h"

#include <algorithm>
#include <cmath>

namespace bdpt_tool {
namespace {

constexpr std::uint32_t kMaxSheetWidth = 4096;
constexpr std::uint32_t kGap = 4;  // pixels between the pictures

// Averages blocks of n x n pixels.
Image shrink(const Image& image, std::uint32_t n) {
  Image small(std::max(image.width / n, 1u), std::max(image.height / n, 1u));
  for (std::uint32_t y = 0; y < small.height; ++y) {
    for (std::uint32_t x = 0; x < small.width; ++x) {
      double sum[3] = {};
      std::uint32_t count = 0;
      for (std::uint32_t v = y * n; v < std::min((y + 1) * n, image.height); ++v) {
        for (std::uint32_t u = x * n; u < std::min((x + 1) * n, image.width); ++u, ++count) {
          for (int c = 0; c < 3; ++c) sum[c] += image.pixels[3 * (std::size_t{v} * image.width + u) + c];
        }
      }
      for (int c = 0; c < 3; ++c) {
        small.pixels[3 * (std::size_t{y} * small.width + x) + c] = static_cast<float>(sum[c] / count);
      }
    }
  }
  return small;
}

void paste(Image& sheet, const Image& image, std::uint32_t x, std::uint32_t y, float factor) {
  for (std::uint32_t row = 0; row < image.height; ++row) {
    const float* from = &image.pixels[std::size_t{3} * row * image.width];
    float* to = &sheet.pixels[3 * (std::size_t{y + row} * sheet.width + x)];
    std::transform(from, from + 3 * image.width, to, [factor](float value) { return value * factor; });
  }
}

// Where each technique has its place on the sheet.
struct Layout {
  std::uint32_t edges, first_t, shrink, cell_width, cell_height, width, height;

  Layout(const bdpt_film_info& info, bool with_t0, std::uint32_t max_width)
      : edges(info.pyramid_edges), first_t(with_t0 ? 0 : 1) {
    const std::uint32_t columns = columns_of(edges);
    shrink = std::max(1u, (columns * (info.width + kGap) + max_width - 1) / max_width);
    cell_width = std::max(info.width / shrink, 1u) + kGap;
    cell_height = std::max(info.height / shrink, 1u) + kGap;
    width = columns * cell_width;
    height = edges * cell_height;
  }

  std::uint32_t columns_of(std::uint32_t k) const { return k + 2 - first_t; }
  std::uint32_t x(std::uint32_t k, std::uint32_t s) const {
    return (width - columns_of(k) * cell_width) / 2 + s * cell_width + kGap / 2;
  }
  std::uint32_t y(std::uint32_t k) const { return (k - 1) * cell_height + kGap / 2; }
};

}  // namespace

Image pyramid_sheet(const bdpt_film* film, const TechniqueMask& mask, bool with_t0, bool partial, bool expose_rows,
                    std::uint32_t max_width) {
  const Layout layout(film_info(film), with_t0, max_width);
  Image sheet(layout.width, layout.height);
  for (std::uint32_t k = 1; k <= layout.edges; ++k) {
    const float factor = expose_rows ? std::exp2(static_cast<float>(k - 1)) : 1;
    for (std::uint32_t s = 0; s + layout.first_t <= k + 1; ++s) {
      if (!allows(mask, s, k + 1 - s)) continue;
      const Image image = read_technique(film, s, k + 1 - s, partial);
      paste(sheet, shrink(image, layout.shrink), layout.x(k, s), layout.y(k), factor);
    }
  }
  return sheet;
}

void write_pyramid(const std::string& folder, const bdpt_film* film, const TechniqueMask& mask, bool with_t0,
                   bool partial, const ViewOptions& options) {
  const std::uint32_t edges = film_info(film).pyramid_edges, first_t = with_t0 ? 0 : 1;
  for (std::uint32_t k = 1; k <= edges; ++k) {
    ViewOptions row_options = options;
    row_options.exposure += static_cast<float>(k - 1);
    for (std::uint32_t s = 0; s + first_t <= k + 1; ++s) {
      const std::uint32_t t = k + 1 - s;
      if (!allows(mask, s, t)) continue;
      Image image = read_technique(film, s, t, partial);
      const std::string path = folder + "/s" + std::to_string(s) + "t" + std::to_string(t);
      write_exr(path + ".exr", image, options.context);
      write_png(path + ".png", std::move(image), row_options);
    }
  }
  write_png(folder + "/pyramid.png", pyramid_sheet(film, mask, with_t0, partial, true, kMaxSheetWidth), options);
}

}  // namespace bdpt_tool
