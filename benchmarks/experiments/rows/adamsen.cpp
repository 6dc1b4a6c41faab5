// Adamsen (2009), section 8.
//
// SPDX-License-Identifier: Apache-2.0
#include "rows/rows.h"
#include "scenes/scenes.h"
#include "tables.h"

namespace bdpt_experiments {

void adamsen_light_up(Report& report) {
  const Setting& setting = report.setting();
  ContestOptions options;
  options.max_edges = 4;
  options.passes = setting.pick(16, 16, 1);
  options.turns = setting.pick(16, 6, 2);
  std::vector<Estimate> ratios, own;
  for (const BoxLight light : {BoxLight::Down, BoxLight::Up}) {
    const Stage stage = build_stage(cornell_box(BoxContents::Boxes, light), setting.pick(400, 200, 24), setting);
    const auto contestants = hold(stage, {bidirectional(), path_tracing()}, options);
    const std::string title = light == BoxLight::Down ? "Light down" : "Light up";
    report.add(contest_table(title + ", the same time", contestants));
    report.compare(title, label(contestants[0]), contestants[0].picture, label(contestants[1]), contestants[1].picture,
                   stage.exposure);
    ratios.push_back(efficiency_ratio(contestants[0].end(), contestants[1].end()));
    own.push_back(relative_variance(contestants[0].end()));
  }
  report.measured("A Cornell box with two diffuse blocks, paths of up to 4 edges.");
  const bool agrees = below(ratios[0], 1) && above(ratios[1], 4);
  report.verdict(agrees ? Verdict::Agrees : Verdict::Differs,
                 "In the same time the efficiency of BDPT over that of path tracing is " + text(ratios[0]) +
                     " with the light down and " + text(ratios[1]) +
                     " with the light up; BDPT's own relative variance is " + text(own[0]) + " and " + text(own[1]) +
                     ".");
}

}  // namespace bdpt_experiments
