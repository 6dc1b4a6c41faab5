// The course project's write-up.
//
// SPDX-License-Identifier: Apache-2.0
#include "rows/rows.h"
#include "scenes/scenes.h"
#include "tables.h"

namespace bdpt_experiments {

void course_two_spheres(Report& report) {
  const Setting& setting = report.setting();
  Variant sixteen = path_tracing();
  sixteen.name = "path tracing, 16 per light";
  sixteen.direct_samples = 16;
  const std::vector<Variant> variants = {bidirectional(), sixteen, path_tracing()};
  ContestOptions options;
  options.max_edges = 9;  // eight bounces
  options.passes = setting.pick(32, 16, 4);
  options.turns = setting.pick(16, 5, 2);
  options.checkpoints = 3;
  std::vector<Estimate> ratios;
  for (const BoxLight light : {BoxLight::Down, BoxLight::Occluded}) {
    const bool open = light == BoxLight::Down;
    const auto contents = open ? BoxContents::MirrorAndGlass : BoxContents::TwoDiffuse;
    const Stage stage = build_stage(cornell_box(contents, light), setting.pick(400, 110, 24), setting, open ? 0.5f : 2);
    const auto contestants = hold(stage, variants, options);
    const Contestant &bdpt = contestants.front(), &path = contestants.back();
    const std::string title = open ? "Mirror and glass" : "Two diffuse spheres, the lamp occluded";
    report.add(contest_table(title + ", the same time", contestants));
    report.add(convergence(title, contestants));
    report.compare(title, label(bdpt), bdpt.picture, label(path), path.picture, stage.exposure);
    ratios.push_back(efficiency_ratio(bdpt.end(), contestants[1].end()));
  }
  report.measured("Paths of up to 9 edges (8 bounces), looked at after a quarter and a half of the samples, too.");
  report.note_missing(variants);
  const bool better = above(ratios[0], 1) && above(ratios[1], 1), most = ratios[1].value > ratios[0].value;
  report.verdict(better && most ? Verdict::Agrees
                 : better       ? Verdict::Partly
                                : Verdict::Differs,
                 "BDPT has " + text(ratios[0]) + " times the efficiency of path tracing with the lamp in sight, and " +
                     text(ratios[1]) + " times with the lamp occluded.");
}

void course_weights(Report& report) {
  const Setting& setting = report.setting();
  Variant power = bidirectional(), average = bidirectional();
  power.name = "power heuristic";
  average.name = "plain average";
  average.heuristic = BDPT_HEURISTIC_AVERAGE;
  ContestOptions options;
  options.max_edges = 2;
  options.passes = setting.pick(16, 16, 2);
  options.turns = setting.pick(16, 5, 2);
  options.equal_time = false;
  const Stage stage =
      build_stage(cornell_box(BoxContents::TwoDiffuse, BoxLight::Down), setting.pick(400, 128, 24), setting, 1);
  const auto contestants = hold(stage, {power, average}, options);
  report.measured("Direct light alone: paths of up to 2 edges.");
  report.add(contest_table("The same samples", contestants));
  report.compare("Direct light", label(contestants[0]), contestants[0].picture, label(contestants[1]),
                 contestants[1].picture, stage.exposure);
  const Estimate ratio = sample_ratio(contestants[0].end(), contestants[1].end());
  report.verdict(above(ratio, 1) ? Verdict::Agrees : Verdict::Differs,
                 "For the same samples the plain average has " + text(ratio) +
                     " times the relative variance of the power heuristic.");
}

}  // namespace bdpt_experiments
