// The camera of a scene description as the library takes it.
//
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene_upload.h"

namespace bdpt_tool {
namespace {

// What the image shows of the plane z = 1: x0, x1, y0, y1, before the field of view widens it. The field of view is
// that of the shorter axis, whatever the window, unless it is the vertical one.
std::array<float, 4> screen_window(const CameraDescription& camera, float image_aspect) {
  if (camera.fov_is_vertical) return {-image_aspect, image_aspect, -1, 1};
  if (camera.screen) return *camera.screen;
  const float aspect = camera.frame_aspect.value_or(image_aspect);
  if (aspect > 1) return {-aspect, aspect, -1, 1};
  return {-1, 1, -1 / aspect, 1 / aspect};
}

void set_crop(const FilmDescription& film, Diagnostics& diagnostics, const Location& where, bdpt_camera_desc& desc) {
  const float size[4] = {float(desc.width), float(desc.width), float(desc.height), float(desc.height)};
  std::int64_t bounds[4];  // x0, x1, y0, y1
  for (int i = 0; i < 4; ++i) {
    bounds[i] = static_cast<std::int64_t>(std::ceil(film.crop_fractions[i] * size[i]));
  }
  if (film.crop_pixels) {
    if (desc.width == film.width && desc.height == film.height) {
      std::copy(film.crop_pixels->begin(), film.crop_pixels->end(), bounds);
    } else {
      diagnostics.warn(where, "pixelbounds is ignored, for the image has another size than in the file");
    }
  }
  const std::int64_t x0 = std::max<std::int64_t>(bounds[0], 0), x1 = std::min<std::int64_t>(bounds[1], desc.width);
  const std::int64_t y0 = std::max<std::int64_t>(bounds[2], 0), y1 = std::min<std::int64_t>(bounds[3], desc.height);
  if (x0 >= x1 || y0 >= y1) throw Error(where, "the crop window holds no pixel");
  if (x0 == 0 && y0 == 0 && x1 == desc.width && y1 == desc.height) return;
  const std::int64_t crop[4] = {x0, y0, x1, y1};
  std::copy(crop, crop + 4, desc.crop);
}

}  // namespace

namespace {

// Of the types that show a part of a plane: its frame.
void set_frame(const CameraDescription& camera, bdpt_camera_desc& desc) {
  const float image_aspect = static_cast<float>(desc.width) / static_cast<float>(desc.height);
  const std::array<float, 4> window = screen_window(camera, image_aspect);
  const float window_width = window[1] - window[0], window_height = window[3] - window[2];
  if (std::abs(window_width / window_height / image_aspect - 1) > 2e-3f) {
    throw Error(camera.where,
                "the screen window and the image are of different shape; pixels must be square, change "
                "screenwindow, frameaspectratio or the resolution");
  }
  if (camera.type == BDPT_CAMERA_ORTHOGRAPHIC) {
    desc.field_height = window_height * camera.screen_scale;
  } else {
    const double tangent = std::tan(camera.fov_short_axis * std::numbers::pi / 360) * window_height / 2;
    desc.field_of_view = static_cast<float>(std::atan(tangent) * 360 / std::numbers::pi);
  }
  desc.shift[0] = (window[0] + window[1]) / 2 / window_width;
  desc.shift[1] = (window[2] + window[3]) / 2 / window_height;
}

void set_lens(const CameraDescription& camera, float diagonal, bdpt_camera_desc& desc) {
  desc.lens_surfaces = camera.lens.data();
  desc.lens_surface_count = static_cast<std::uint32_t>(camera.lens.size());
  desc.lens_unit = camera.lens_unit;
  desc.film_height = diagonal * static_cast<float>(desc.height) /
                     std::hypot(static_cast<float>(desc.width), static_cast<float>(desc.height));
}

}  // namespace

bdpt_camera_desc camera_desc(const SceneDescription& description, std::uint32_t width, std::uint32_t height,
                             Diagnostics& diagnostics, const CameraOptions& options) {
  const CameraDescription& camera = description.camera;
  auto desc = sized<bdpt_camera_desc>();
  desc.width = width;
  desc.height = height;
  desc.type = options.type.value_or(camera.type);
  set_crop(description.film, diagnostics, camera.where, desc);
  std::copy_n(camera.transform.data(), 12, desc.transform);
  if (camera.end_transform) std::copy_n(camera.end_transform->data(), 12, desc.end_transform);
  if (desc.type == camera.type) {
    if (desc.type == BDPT_CAMERA_PERSPECTIVE || desc.type == BDPT_CAMERA_ORTHOGRAPHIC) set_frame(camera, desc);
    if (desc.type == BDPT_CAMERA_LENS) set_lens(camera, description.film.diagonal, desc);
    desc.lens_radius = camera.lens_radius;
    desc.focus_distance = camera.focus_distance;
  }
  if (options.field_of_view) desc.field_of_view = *options.field_of_view;
  if (options.field_height) desc.field_height = *options.field_height;
  return desc;
}

}  // namespace bdpt_tool
