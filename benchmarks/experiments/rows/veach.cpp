// Veach (1997), chapter 10.
//
// SPDX-License-Identifier: Apache-2.0
#include "film_output.h"
#include "rows/rows.h"
#include "scenes/scenes.h"
#include "tables.h"

namespace bdpt_experiments {

void veach_egg_room(Report& report) {
  const Setting& setting = report.setting();
  const Stage stage = build_stage(bitterli_scene(setting, "veach-bidir"), setting.pick(500, 144, 32), setting);
  ContestOptions options;
  options.max_edges = 5;
  options.passes = setting.pick(25, 25, 1);
  options.turns = setting.pick(16, 5, 2);
  const auto contestants = hold(stage, {bidirectional(), path_tracing()}, options);
  const Contestant &bdpt = contestants[0], &path = contestants[1];
  report.measured("The scene of figure 10.3 as Bitterli built it, paths of up to 5 edges, power heuristic.");
  report.add(contest_table("The same time", contestants));
  const Estimate ratio = efficiency_ratio(bdpt.end(), path.end());
  report.verdict(above(ratio, 2)   ? Verdict::Agrees
                 : below(ratio, 2) ? Verdict::Differs
                                   : Verdict::Open,
                 "In the same time BDPT has " + text(ratio) + " times the efficiency of path tracing.");
  report.compare("Figure 10.3", label(bdpt), bdpt.picture, label(path), path.picture, stage.exposure);

  Job job(stage, bidirectional(), options.max_edges, 1, options.max_edges);
  job.advance(setting.pick<std::uint64_t>(200, 24, 1));
  report.pyramid("Figure 10.4: the weighted techniques; row r is exposed by r stops", job.film(), false, true,
                 stage.exposure);
  report.compare("Figure 10.5: two techniques alone", "(2,2)", bdpt_tool::read_technique(job.film(), 2, 2, false),
                 "(5,1), exposed alike", bdpt_tool::read_technique(job.film(), 5, 1, false), stage.exposure + 4);
}

void veach_shrinking_patch(Report& report) {
  const Setting& setting = report.setting();
  ContestOptions options;
  options.max_edges = 5;
  options.passes = setting.pick(16, 16, 1);
  options.turns = setting.pick(16, 5, 2);
  Table table{"The same time, while the patch shrinks",
              {"radius of the patch", "BDPT: relative variance", "path tracing: relative variance",
               "efficiency of BDPT / path tracing"},
              {}};
  Plot plot{"Relative variance in the same time", "radius of the patch, ceiling 4 wide", "relative variance", {}};
  plot.series = {{"BDPT", {}, {}}, {"path tracing", {}, {}}};
  std::vector<Estimate> ratios, own;
  for (const float radius : {1.f, 0.5f, 0.25f, 0.125f, 0.0625f}) {
    const Stage stage = build_stage(shrinking_patch(radius), setting.pick(400, 96, 24), setting, 0.5f);
    const auto contestants = hold(stage, {bidirectional(), path_tracing()}, options);
    const Estimate bdpt = relative_variance(contestants[0].end()), path = relative_variance(contestants[1].end());
    ratios.push_back(efficiency_ratio(contestants[0].end(), contestants[1].end()));
    own.push_back(bdpt);
    table.rows.push_back({double(radius), bdpt, path, ratios.back()});
    plot.series[0].x.push_back(radius), plot.series[0].y.push_back(bdpt);
    plot.series[1].x.push_back(radius), plot.series[1].y.push_back(path);
    if (radius == 1.f || radius == 0.125f)
      report.compare("Radius " + text(Estimate{radius, 0}), label(contestants[0]), contestants[0].picture,
                     label(contestants[1]), contestants[1].picture, stage.exposure);
  }
  report.measured("A closed room whose only lamp, a spot of constant flux, lights a round patch of the ceiling.");
  report.add(std::move(table));
  report.add(std::move(plot));
  const double growth = ratios.back().value / ratios.front().value, change = own.back().value / own.front().value;
  report.verdict(growth > 4 && change < 2 ? Verdict::Agrees : Verdict::Differs,
                 "From radius 1 to 1/16 the advantage of BDPT grows " + text(Estimate{growth, 0}) +
                     " times, and its own relative variance changes by a factor of " + text(Estimate{change, 0}) + ".");
}

namespace {

// Of each technique that has a hundredth of the connections or more.
Table saved_rays(const std::string& title, const Job& job) {
  Table table{title, {"(s,t)", "of all connections, %", "rays saved, %", "energy, %"}, {}};
  double all = 0;
  for (int round = 0; round < 2; ++round)
    for (std::uint32_t k = 1; k <= 6; ++k)
      for (std::uint32_t s = 1; s <= k; ++s) {
        const bdpt_technique_stats stats = job.technique(s, k + 1 - s);
        const double own = double(stats.contributions);
        if (round == 0)
          all += own;
        else if (own > 0.01 * all)
          table.rows.push_back(
              {std::string("(").append(std::to_string(s)).append(",").append(std::to_string(k + 1 - s)) + ")",
               100 * own / all, 100 * double(stats.shadow_rays_skipped) / own, 100 * stats.energy});
      }
  return table;
}

}  // namespace

void veach_roulette(Report& report) {
  const Setting& setting = report.setting();
  Variant none = bidirectional(), low = none, high = none, efficiency = none;
  none.name = "no roulette";
  low.name = "threshold 0.01", low.roulette = BDPT_SHADOW_ROULETTE_FIXED, low.roulette_threshold = 0.01f;
  high.name = "threshold 0.1", high.roulette = BDPT_SHADOW_ROULETTE_FIXED, high.roulette_threshold = 0.1f;
  efficiency.name = "efficiency-optimised", efficiency.roulette = BDPT_SHADOW_ROULETTE_EFFICIENCY;
  const std::vector<Variant> variants = {efficiency, low, high, none};
  std::vector<Estimate> over_none;
  for (const char* name : {"veach-bidir", "veach-ajar"}) {
    const Stage stage = build_stage(bitterli_scene(setting, name), setting.pick(400, 128, 24), setting, 1);
    ContestOptions options;
    options.max_edges = 6;
    options.passes = setting.pick(32, 16, 2);
    options.turns = setting.pick(16, 5, 2);
    const auto contestants = hold(stage, variants, options);
    Table rays{std::string(name) + ": rays for a sample", {"", "shadow rays", "all rays"}, {}};
    for (const Contestant& c : contestants) {
      const double samples = double(c.stats.samples), shadow = double(c.stats.shadow_rays);
      rays.rows.push_back({c.variant.name, shadow / samples,
                           (shadow + double(c.stats.eye_rays) + double(c.stats.light_rays)) / samples});
    }
    report.add(contest_table(std::string(name) + ", the same time", contestants));
    report.add(std::move(rays));
    report.add(saved_rays(std::string(name) + ": what the efficiency-optimised roulette saves", *contestants[0].first));
    over_none.push_back(efficiency_ratio(contestants.front().end(), contestants.back().end()));
  }
  report.measured("Paths of up to 6 edges.");
  const bool both = above(over_none[0], 1) && above(over_none[1], 1);
  report.verdict(both ? Verdict::Agrees : Verdict::Differs,
                 "Over no roulette the efficiency-optimised one has " + text(over_none[0]) +
                     " times the efficiency in the egg room and " + text(over_none[1]) + " times at the door ajar.");
}

}  // namespace bdpt_experiments
