// From a film to images in memory and in files.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "handles.h"
#include "image.h"

namespace bdpt_tool {

struct ViewOptions {
  bdpt_view view = BDPT_VIEW_SRGB;
  float exposure = 0;                     // stops
  bool is_named = false;                  // the view; else it is the default
  std::string display, ocio_view;         // of BDPT_VIEW_OCIO; empty = the configuration's defaults
  const bdpt_context* context = nullptr;  // in whose rendering space the pixels are; NULL = linear Rec. 709
  float iso = 0, shutter = 0, f_number = 0;  // 0 = not given
  std::optional<float> ev100;
};

// Reads a film file. An Error of kInput if there is none or it is damaged.
Film load_film(bdpt_context* context, const std::string& path);

// `partial`: with the part of a pass that was interrupted.
Image read_layer(const bdpt_film* film, bdpt_layer layer, bool partial);
Image read_technique(const bdpt_film* film, std::uint32_t s, std::uint32_t t, bool partial);

// The film's colour, and its variance, once there is one, as a layer of that name. The files name the chromaticities of
// the context's rendering space; NULL = linear Rec. 709.
void write_film_exr(const std::string& path, const bdpt_film* film, bool partial,
                    const bdpt_context* context = nullptr);
void write_exr(const std::string& path, const Image& image, const bdpt_context* context = nullptr);
// Images of one size as layers; the first is the main one, too.
void write_layers(const std::string& path, const std::vector<Image>& images, const std::vector<std::string>& names);

// Whether pictures can be shown so: an Error of kInput for names that the configuration does not have.
void check_view(const ViewOptions& options);

// In stops, of all that was given. An Error of kUsage where that makes no exposure.
float exposure_of(const ViewOptions& options);
// Through the display transform.
void write_png(const std::string& path, Image image, const ViewOptions& options);

}  // namespace bdpt_tool
