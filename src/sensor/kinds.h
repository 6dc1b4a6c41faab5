// The functions behind the table in camera.cpp; each is defined in the file of its kind.
#pragma once

#include "sensor/camera.h"

namespace bdpt {

using MakeFunction = std::shared_ptr<const Camera>(const CameraDesc&);

MakeFunction make_perspective, make_orthographic, make_fisheye, make_equirectangular, make_cube_map, make_lens_camera;

}  // namespace bdpt
