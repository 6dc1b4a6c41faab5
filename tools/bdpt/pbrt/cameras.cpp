// SPDX-License-Identifier: Apache-2.0
#include "pbrt/cameras.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

namespace bdpt_tool {
namespace {

constexpr double kMillimetre = 0.001;  // the format's lenses are in millimetres, its scenes in metres
constexpr std::size_t kMostSurfaces = 64;

// What a kind of camera is read from.
struct CameraSource {
  const ParamList& params;
  float scale;  // world units in one of the format's camera
  const SceneFolder& folder;
};

// The library's camera looks along -z.
constexpr Transform kTurned = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}}};

void read_window(const CameraSource& source, CameraDescription& camera) {
  const ParamList& params = source.params;
  const std::vector<float> window = params.get_floats("screenwindow");
  if (!window.empty()) {
    if (window.size() != 4 || !(window[0] < window[1] && window[2] < window[3])) {
      params.fail("screenwindow needs four numbers x0 x1 y0 y1, with x0 < x1 and y0 < y1");
    }
    camera.screen = {{window[0], window[1], window[2], window[3]}};
  }
  if (params.has("frameaspectratio")) {
    camera.frame_aspect = params.get_float("frameaspectratio", 1);
    if (!(*camera.frame_aspect > 0)) params.fail("frameaspectratio must be greater than zero");
  }
}

Transform read_perspective(const CameraSource& source, CameraDescription& camera, Diagnostics&) {
  const ParamList& params = source.params;
  camera.fov_short_axis = params.get_float("fov", 90);
  if (!(camera.fov_short_axis > 0 && camera.fov_short_axis < 180)) params.fail("fov must be between 0 and 180 degrees");
  read_window(source, camera);
  // Both are lengths in camera space.
  camera.lens_radius = params.get_float("lensradius", 0) * source.scale;
  camera.focus_distance = params.get_float("focaldistance", 1e6f) * source.scale;
  if (camera.lens_radius < 0) params.fail("lensradius must not be negative");
  if (!(camera.focus_distance > 0)) params.fail("focaldistance must be greater than zero");
  if (camera.lens_radius == 0) camera.focus_distance = 0;
  return kTurned;
}

Transform read_orthographic(const CameraSource& source, CameraDescription& camera, Diagnostics& diagnostics) {
  camera.type = BDPT_CAMERA_ORTHOGRAPHIC;
  camera.screen_scale = source.scale;
  read_window(source, camera);
  if (source.params.get_float("lensradius", 0) != 0) {
    source.params.warn_ignored("lensradius", "is ignored: an orthographic camera has no lens here", diagnostics);
  }
  source.params.ignore("focaldistance");
  return kTurned;
}

// The format's panorama begins to the right and turns to the front, to the left and to the back; the library's has the
// front in the middle and its right to the right.
Transform read_spherical(const CameraSource& source, CameraDescription& camera, Diagnostics&) {
  const std::string mapping = source.params.get_string("mapping", "equalarea");
  if (mapping != "equirectangular") {
    source.params.fail("the mapping '" + mapping + "' is not known; use equirectangular");
  }
  camera.type = BDPT_CAMERA_EQUIRECTANGULAR;
  return {{{0, 0, 1, 0}, {0, 1, 0, 0}, {-1, 0, 0, 0}}};
}

// Rows of four numbers: radius of curvature, thickness, index of refraction, diameter; # begins a comment.
std::vector<bdpt_lens_surface> read_lens(const ParamList& params, const SceneFolder& folder) {
  const Param* param = params.find("lensfile");
  const std::string file = params.get_string("lensfile", "");
  if (file.empty()) params.fail("\"string lensfile\" is missing");
  const std::filesystem::path path = folder.path_of(file, param->where);
  std::ifstream stream(path);
  if (!stream || std::filesystem::is_directory(path)) params.fail(*param, "cannot be read: " + path.string());
  std::vector<bdpt_lens_surface> surfaces;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::vector<double> row;
    for (std::string word; words >> word;) {
      std::size_t used = 0;
      double value = NAN;
      try {
        value = std::stod(word, &used);
      } catch (const std::exception&) {
      }
      if (used != word.size() || !std::isfinite(value)) {
        params.fail(*param, "has '" + word.substr(0, 40) + "' in line " + std::to_string(number) + ": not a number");
      }
      row.push_back(value);
    }
    if (row.empty()) continue;
    if (row.size() != 4 || surfaces.size() == kMostSurfaces) {
      params.fail(*param, "line " + std::to_string(number) + ": give up to 64 lines of radius, thickness, index of " +
                              "refraction and diameter");
    }
    surfaces.push_back({static_cast<float>(row[0]), static_cast<float>(row[1]), static_cast<float>(row[2]),
                        static_cast<float>(row[3])});
  }
  if (surfaces.empty()) params.fail(*param, "holds no surface");
  return surfaces;
}

// The format puts the film at the origin, the library the first surface.
Transform read_realistic(const CameraSource& source, CameraDescription& camera, Diagnostics& diagnostics) {
  const ParamList& params = source.params;
  camera.type = BDPT_CAMERA_LENS;
  camera.lens = read_lens(params, source.folder);
  camera.lens_unit = static_cast<float>(kMillimetre) * source.scale;
  if (params.has("aperturediameter")) {
    const float diameter = params.get_float("aperturediameter", 1);
    if (!(diameter > 0)) params.fail("aperturediameter must be greater than zero");
    for (bdpt_lens_surface& surface : camera.lens) {
      if (surface.radius == 0 && diameter < surface.aperture) surface.aperture = diameter;
    }
  }
  params.warn_ignored("aperture", "is ignored: the stop is round", diagnostics);
  double length = 0;
  for (const bdpt_lens_surface& surface : camera.lens) length += static_cast<double>(surface.thickness);
  length *= kMillimetre;
  const double focus = static_cast<double>(params.get_float("focusdistance", 10)) - length;
  if (!(focus > 0)) params.fail("focusdistance lies within the lens; it is measured from the film, in metres");
  camera.focus_distance = static_cast<float>(focus) * source.scale;
  diagnostics.warn(params.where(), params.directive() + ": a radiance of 1 gives 1 in the middle of the picture");
  return translation(0, 0, length) * kTurned;
}

TimeRange read_shutter(const ParamList& params, Diagnostics& diagnostics) {
  TimeRange shutter = {static_cast<double>(params.get_float("shutteropen", 0)),
                       static_cast<double>(params.get_float("shutterclose", 1))};
  if (shutter[1] < shutter[0]) {
    diagnostics.warn(params.where(), params.directive() + ": the shutter closes before it opens; both are exchanged");
    std::swap(shutter[0], shutter[1]);
  }
  return shutter;
}

// Returns what leads from the library's camera to the format's, which looks along +z.
using ReadFunction = Transform(const CameraSource&, CameraDescription&, Diagnostics&);
struct Kind {
  const char* name;
  ReadFunction* read;
};
constexpr Kind kKinds[] = {{"perspective", read_perspective},
                           {"orthographic", read_orthographic},
                           {"spherical", read_spherical},
                           {"realistic", read_realistic}};

}  // namespace

void read_camera(const std::string& type, const ParamList& params, const MovingTransform& world_to_camera,
                 const TimeRange& times, TimeRange& shutter, const SceneFolder& folder, SceneDescription& scene,
                 Diagnostics& diagnostics) {
  const Kind* known = nullptr;
  for (const Kind& kind : kKinds) {
    if (type == kind.name) known = &kind;
  }
  if (!known) {
    params.fail("the camera '" + type + "' is not known; use perspective, orthographic, spherical or realistic");
  }
  CameraDescription camera;
  camera.where = params.where();
  for (const Transform& transform : {world_to_camera.start, world_to_camera.end}) {
    if (!transform.is_invertible()) params.fail("the transform before it is singular");
    if (uniform_scale(transform) == 0)
      params.fail("the transform before it scales differently along its axes, or shears; remove that");
  }
  shutter = read_shutter(params, diagnostics);
  const double scale = uniform_scale(world_to_camera.start);
  const Transform local = known->read({params, static_cast<float>(1 / scale), folder}, camera, diagnostics);
  const MovingTransform to_world = camera_in_shutter(world_to_camera.inverse(), times, shutter);
  if (to_world.moves() && rests_in_shutter(times, shutter)) {
    diagnostics.warn(params.where(), params.directive() +
                                         ": moves during a part of the exposure alone; here it moves as "
                                         "far, evenly, during all of it");
  }
  camera.transform = (to_world.start * local).rows();
  if (to_world.moves()) camera.end_transform = (to_world.end * local).rows();
  params.warn_unused(diagnostics);
  scene.camera = camera;
}

}  // namespace bdpt_tool
