// SPDX-License-Identifier: Apache-2.0
#include "scenes/scenes.h"
#include "stage.h"

namespace bdpt_experiments {

std::vector<NamedScene> scenes_of_the_table(const Setting& setting) {
  const auto bitterli = [setting](const char* name) { return [=] { return bitterli_scene(setting, name); }; };
  return {
      {"Cornell box", [] { return cornell_box(BoxContents::Boxes, BoxLight::Down); }},
      {"Cornell box, light up", [] { return cornell_box(BoxContents::Boxes, BoxLight::Up); }},
      {"Cornell box, glass sphere", [] { return cornell_box(BoxContents::GlassSphere, BoxLight::Down); }},
      {"spheres under a small lamp", brown_spheres},
      {"meshes under a small lamp", brown_meshes},
      {"lit ceiling patch, r = 1/4", [] { return shrinking_patch(0.25f); }},
      {"stacked houses", stacked_houses},
      {"bathroom", bathroom},
      {"hall of 100 lamps", [] { return lamp_hall(100); }},
      {"egg room", bitterli("veach-bidir")},
      {"door ajar", bitterli("veach-ajar")},
      {"plates and lamps", bitterli("veach-mis")},
      {"water caustic", bitterli("water-caustic")},
  };
}

}  // namespace bdpt_experiments
