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
  options.turns = setting.pick(16, 5, 2);
  std::vector<Estimate> ratios, own;
  for (const BoxLight light : {BoxLight::Down, BoxLight::Up}) {
    const Stage stage = build_stage(cornell_box(BoxContents::Boxes, light), setting.pick(400, 128, 24), setting, 1);
    const auto contestants = hold(stage, {bidirectional(), path_tracing()}, options);
    const std::string title = light == BoxLight::Down ? "Light down" : "Light up";
    report.add(contest_table(title + ", the same time", contestants));
    report.compare(title, label(contestants[0]), contestants[0].picture, label(contestants[1]), contestants[1].picture,
                   stage.exposure);
    ratios.push_back(efficiency_ratio(contestants[0].end(), contestants[1].end()));
    own.push_back(relative_variance(contestants[0].end()));
  }
  report.measured("A Cornell box with two diffuse blocks, paths of up to 4 edges.");
  const bool down = below(ratios[0], 1), up = above(ratios[1], 4);
  report.verdict(down && up ? Verdict::Agrees
                 : up       ? Verdict::Partly
                            : Verdict::Differs,
                 "In the same time the efficiency of BDPT over that of path tracing is " + text(ratios[0]) +
                     " with the light down and " + text(ratios[1]) +
                     " with the light up; BDPT's own relative variance is " + text(own[0]) + " and " + text(own[1]) +
                     ".");
}

void adamsen_glass_sphere(Report& report) {
  const Setting& setting = report.setting();
  ContestOptions options;
  options.max_edges = 4;
  options.passes = setting.pick(32, 24, 1);
  options.turns = setting.pick(16, 5, 2);
  const Stage stage =
      build_stage(cornell_box(BoxContents::GlassSphere, BoxLight::Down), setting.pick(400, 128, 24), setting, 0.5f);
  const auto contestants = hold(stage, {bidirectional(), path_tracing()}, options);
  report.measured("A Cornell box with a glass sphere, paths of up to 4 edges.");
  report.add(contest_table("The same time", contestants));
  report.compare("Figure 15", label(contestants[0]), contestants[0].picture, label(contestants[1]),
                 contestants[1].picture, stage.exposure);
  const Estimate ratio = efficiency_ratio(contestants[0].end(), contestants[1].end());
  report.verdict(above(ratio, 2) ? Verdict::Agrees : Verdict::Differs,
                 "In the same time BDPT has " + text(ratio) + " times the efficiency of path tracing.");

  for (const bool weighted : {true, false}) {
    Variant variant = bidirectional();
    if (!weighted) variant.heuristic = BDPT_HEURISTIC_NONE;
    Job job(stage, variant, options.max_edges, 1, options.max_edges);
    job.advance(setting.pick<std::uint64_t>(200, 32, 1));
    report.pyramid(weighted ? "Figure 16: the weighted techniques" : "Figure 10: the techniques without weights",
                   job.film(), false, weighted, stage.exposure);
  }
}

}  // namespace bdpt_experiments
