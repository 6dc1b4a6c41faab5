// What the tests of pbrt's scenes in the picture share: a scene from its text, rendered small.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>

#include "film_output.h"
#include "scene_upload.h"
#include "temp_folder.h"
#include "transform.h"

namespace bdpt_tool {

class ToolPicture : public testing::Test {
 protected:
  static constexpr std::uint32_t kSize = 16;

  SceneDescription read(const std::string& head, const std::string& world) {
    std::ofstream(folder_.file("scene.pbrt")) << head << "\nWorldBegin\n" << world;
    return read_scene(folder_.file("scene.pbrt"), diagnostics_);
  }

  Image render(SceneDescription description, std::uint32_t passes = 16) {
    const Context context = make_context(2, diagnostics_);
    const bdpt_camera_desc camera = camera_desc(description, kSize, kSize, diagnostics_);
    const Sensor sensor = make<Sensor>("camera", bdpt_camera_create, context.get(), &camera);
    const Scene scene = build_scene(context.get(), description);
    const auto film_desc = sized<bdpt_film_desc>();
    const Film film = make<Film>("film", bdpt_film_create, sensor.get(), &film_desc);
    auto desc = sized<bdpt_render_desc>();
    desc.max_edges = max_edges_;
    const Render render = make<Render>("render", bdpt_render_create, scene.get(), sensor.get(), film.get(), &desc);
    auto advance = sized<bdpt_advance_desc>();
    advance.passes = passes;
    check(bdpt_render_advance(render.get(), &advance, nullptr), "advance");
    return read_layer(film.get(), BDPT_LAYER_COLOR, false);
  }
  // The mean over the picture.
  Rgb radiance(SceneDescription description) {
    const Image image = render(std::move(description));
    std::array<double, 3> sum = {};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) sum[i % 3] += double{image.pixels[i]};
    const double pixels = double{kSize} * kSize;
    return {float(sum[0] / pixels), float(sum[1] / pixels), float(sum[2] / pixels)};
  }
  static void expect_near(const Rgb& a, const Rgb& b, float tolerance) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance * std::max(b[c], 0.01f)) << "channel " << c;
  }
  void write(const std::string& name, std::uint32_t size, const std::function<Rgb(double u, double v)>& color) {
    Image image(size, size);
    for (std::uint32_t y = 0; y < size; ++y) {
      for (std::uint32_t x = 0; x < size; ++x) {
        const Rgb rgb = color((x + 0.5) / size, (y + 0.5) / size);
        std::copy(rgb.begin(), rgb.end(), &image.pixels[3 * (std::size_t{y} * size + x)]);
      }
    }
    const Context context = make_context(1, diagnostics_);
    write_exr(folder_.file(name), image, context.get());
  }
  static std::string look_along(const Vec3& d) {
    std::ostringstream text;
    text << "LookAt 0 0 0 " << d[0] << " " << d[1] << " " << d[2]
         << " 0.1 0.2 1\nCamera \"perspective\" \"float fov\" 0.5";
    return text.str();
  }

  std::size_t notes_with(const std::string& part) const {
    std::size_t count = 0;
    for (const std::string& text : diagnostics_.texts()) count += text.find(part) != std::string::npos;
    return count;
  }

  bdpt::TempFolder folder_;
  Diagnostics diagnostics_{false};
  std::uint32_t max_edges_ = 2;
};

}  // namespace bdpt_tool
