// SPDX-License-Identifier: Apache-2.0
#include "film_output.h"

namespace bdpt_tool {
namespace {

// A failure to write is a failure of the output, whatever the library calls it.
void check_output(bdpt_result result, const std::string& path) {
  if (result < 0) throw Error(ExitCode::kOutput, "cannot write '" + path + "': " + bdpt_last_error());
}

bdpt_chromaticities chromaticities(const bdpt_context* context) {
  auto info = sized<bdpt_color_info>();
  check(bdpt_color_get_info(context, &info), "the colour space");
  return info.chromaticities;
}

// In the rendering space of a context.
void write_layers_of(const std::string& path, bdpt_exr_desc desc, const bdpt_context* context) {
  bdpt_chromaticities own;
  if (context) {
    own = chromaticities(context);
    desc.chromaticities = &own;
  }
  check_output(bdpt_image_write_exr(path.c_str(), &desc), path);
}

Image read(const bdpt_film* film, bdpt_read_desc desc, bool partial) {
  const bdpt_film_info info = film_info(film);
  Image image(info.width, info.height);
  desc.include_partial = partial;
  check(bdpt_film_read(film, &desc, image.pixels.data(), image.pixels.size() * sizeof(float)), "reading the film");
  return image;
}

// Turns a picture into display values.
void show(Image& image, const ViewOptions& options) {
  auto desc = sized<bdpt_display_desc>();
  desc.view = options.view;
  desc.exposure = exposure_of(options);
  desc.context = options.context;
  if (!options.display.empty()) desc.display = options.display.c_str();
  if (!options.ocio_view.empty()) desc.ocio_view = options.ocio_view.c_str();
  const bdpt_result result = bdpt_image_display(&desc, image.pixels.data(), image.width, image.height);
  if (result == BDPT_ERROR_IO) throw Error(ExitCode::kInput, bdpt_last_error());  // a table of the configuration
  check(result, "the display transform");
}

}  // namespace

Film load_film(bdpt_context* context, const std::string& path) {
  bdpt_film* film = nullptr;
  const bdpt_result result = bdpt_film_load(context, path.c_str(), &film);
  if (result == BDPT_ERROR_IO || result == BDPT_ERROR_FORMAT) throw Error(Location{path, 0}, bdpt_last_error());
  check(result, path);
  return Film(film);
}

Image read_layer(const bdpt_film* film, bdpt_layer layer, bool partial) {
  auto desc = sized<bdpt_read_desc>();
  desc.layer = layer;
  return read(film, desc, partial);
}

Image read_technique(const bdpt_film* film, std::uint32_t s, std::uint32_t t, bool partial) {
  auto desc = sized<bdpt_read_desc>();
  desc.layer = BDPT_LAYER_TECHNIQUE;
  desc.s = s;
  desc.t = t;
  return read(film, desc, partial);
}

void write_film_exr(const std::string& path, const bdpt_film* film, bool partial, const bdpt_context* context) {
  const Image color = read_layer(film, BDPT_LAYER_COLOR, partial);
  const bool has_variance = film_info(film).relative_error >= 0;
  const Image variance = has_variance ? read_layer(film, BDPT_LAYER_VARIANCE, partial) : Image();
  const bdpt_image_layer layers[2] = {{nullptr, color.pixels.data()}, {"variance", variance.pixels.data()}};
  auto desc = sized<bdpt_exr_desc>();
  desc.width = color.width;
  desc.height = color.height;
  desc.layers = layers;
  desc.layer_count = has_variance ? 2 : 1;
  write_layers_of(path, desc, context);
}

void write_exr(const std::string& path, const Image& image, const bdpt_context* context) {
  const bdpt_image_layer layer = {nullptr, image.pixels.data()};
  auto desc = sized<bdpt_exr_desc>();
  desc.width = image.width;
  desc.height = image.height;
  desc.layers = &layer;
  desc.layer_count = 1;
  write_layers_of(path, desc, context);
}

void write_layers(const std::string& path, const std::vector<Image>& images, const std::vector<std::string>& names) {
  std::vector<bdpt_image_layer> layers = {{nullptr, images[0].pixels.data()}};
  for (std::size_t i = 0; i < images.size(); ++i) layers.push_back({names[i].c_str(), images[i].pixels.data()});
  auto desc = sized<bdpt_exr_desc>();
  desc.width = images[0].width;
  desc.height = images[0].height;
  desc.layers = layers.data();
  desc.layer_count = static_cast<std::uint32_t>(layers.size());
  check_output(bdpt_image_write_exr(path.c_str(), &desc), path);
}

void check_view(const ViewOptions& options) {
  Image image(1, 1);
  show(image, options);
}

float exposure_of(const ViewOptions& options) {
  if (options.iso == 0 && options.shutter == 0 && options.f_number == 0 && !options.ev100) return options.exposure;
  auto desc = sized<bdpt_exposure_desc>();
  desc.iso = options.iso;
  desc.shutter_time = options.shutter;
  desc.f_number = options.f_number;
  desc.ev100 = options.ev100.value_or(0);
  float stops = 0;
  if (bdpt_exposure_stops(&desc, &stops) != BDPT_OK) {
    throw Error(ExitCode::kUsage, std::string("--iso, --shutter, --f-number, --ev100: ") + bdpt_last_error());
  }
  return options.exposure + stops;
}

void write_png(const std::string& path, Image image, const ViewOptions& options) {
  show(image, options);
  check_output(bdpt_image_write_png(path.c_str(), image.pixels.data(), image.width, image.height), path);
}

}  // namespace bdpt_tool
