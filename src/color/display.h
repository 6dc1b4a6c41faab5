// From scene-referred colour to what a display shows, by OpenColorIO.
#pragma once

#include <cstdint>
#include <string>

namespace bdpt {

class ColorSpaces;

enum class DisplayView {
  Srgb,  // the sRGB curve, clipped
  Aces,  // ACES 1.0 SDR video output transform, on an sRGB display
  Ocio,  // a display and view of a configuration file
};

struct DisplayOptions {
  DisplayView view = DisplayView::Srgb;
  float exposure = 0;  // stops
  // Whose rendering space the pixels are in, and whose configuration the Ocio view takes. NULL: linear Rec. 709, none.
  const ColorSpaces* spaces = nullptr;
  // Of the Ocio view; what is empty takes its default.
  std::string config;       // path; the configuration of spaces
  std::string color_space;  // of the pixels; the rendering space of spaces; the role scene_linear
  std::string display;      // the configuration's default
  std::string ocio_view;    // the display's default
};

// Turns linear pixels (3 floats each, packed) into display values in [0,1], in place. Every input has a result: a
// value that is not a number counts as 0, infinities as the largest half float.
// Errors: InvalidArgument (also for names that the configuration does not have), Io (no such configuration, or a
// table of it is missing), Format (the configuration is damaged).
void to_display(const DisplayOptions& options, float* pixels, uint32_t width, uint32_t height);

}  // namespace bdpt
