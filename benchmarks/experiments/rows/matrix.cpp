// Chaitanya et al. (2018), matrix bidirectional path tracing.
//
// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "film_output.h"
#include "rows/rows.h"
#include "scenes/scenes.h"
#include "tables.h"

namespace bdpt_experiments {
namespace {

Variant matrix(std::uint32_t connections = 0) {
  Variant variant = of_plan("matrix");
  variant.connections = connections;
  if (connections) variant.name += ", m = " + std::to_string(connections);
  return variant;
}

Variant sobol(Variant variant) {
  variant.name += ", Sobol";
  return variant;
}

struct Outcome {
  Estimate over_bdpt;  // efficiency of matrix over that of BDPT
  std::string others;  // sentences on MMLT, and on Sobol's points
};

// BDPT, matrix and MMLT over time. The paper's renderer drew independent points, and so do these; what Sobol's points
// do is told beside it.
Outcome converge(Report& report, const Stage& stage, std::uint32_t max_edges) {
  const Setting& setting = report.setting();
  const Variant bdpt = bidirectional(), mmlt = of_plan("mmlt");
  const std::vector<Variant> variants = {independent(bdpt), independent(matrix()), independent(mmlt), sobol(bdpt),
                                         sobol(matrix())};
  ContestOptions options;
  options.max_edges = max_edges;
  options.passes = setting.pick(64, 32, 8);
  options.turns = setting.pick(16, 4, 2);
  options.checkpoints = setting.pick(4, 3, 1);
  const auto contestants = hold(stage, variants, options);
  const Contestant &one = contestants[0], &matrix = contestants[1];
  report.add(contest_table("The same time", contestants));
  report.add(convergence("Over time", contestants));
  report.compare("In the same time", label(one), one.picture, label(matrix), matrix.picture, stage.exposure);
  report.note_missing(variants);
  Outcome outcome{efficiency_ratio(matrix.end(), one.end()), ""};
  if (const Contestant* chains = find(contestants, mmlt.name)) {
    report.compare("In the same time", label(matrix), matrix.picture, label(*chains), chains->picture, stage.exposure);
    outcome.others = " Over MMLT it has " + text(efficiency_ratio(matrix.end(), chains->end())) + " times.";
  }
  const Estimate with_sobol = efficiency_ratio(contestants.back().end(), contestants[contestants.size() - 2].end());
  outcome.others += " With Sobol's points for both it is " + text(with_sobol) + " times that of BDPT.";
  return outcome;
}

void judge_faster(Report& report, const Outcome& outcome) {
  const Estimate& ratio = outcome.over_bdpt;
  const bool twice = !below(ratio, 2);
  report.verdict(twice             ? Verdict::Agrees
                 : above(ratio, 1) ? Verdict::Partly
                                   : Verdict::Differs,
                 "With independent points, as in the paper, matrix has " + text(ratio) +
                     " times the efficiency of BDPT: so many times faster to the same error." + outcome.others);
}

}  // namespace

void matrix_techniques(Report& report) {
  const Setting& setting = report.setting();
  const std::uint32_t edges = 5;
  const std::size_t turns = setting.pick(16, 6, 2);
  const std::uint64_t passes = setting.pick(16, 16, 8);
  const Stage stage =
      build_stage(cornell_box(BoxContents::Boxes, BoxLight::Down), setting.pick(300, 96, 16), setting, 1);
  // images[variant][(s,t)][turn], in the order of `techniques`.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> techniques;
  for (std::uint32_t k = 2; k <= edges; ++k)
    for (std::uint32_t s = 1; s <= k; ++s) techniques.push_back({s, k + 1 - s});
  const Variant variants[2] = {independent(bidirectional()), independent(matrix())};
  std::vector<std::vector<std::vector<float>>> images[2];
  double spent[2] = {};
  bdpt_tool::Image inner[2];
  for (auto& of : images) of.resize(techniques.size());
  for (std::size_t turn = 0; turn < turns; ++turn)
    for (int v = 0; v < 2; ++v) {
      Job job(stage, variants[v], edges, turn + 1, edges);
      spent[v] += job.advance(passes);
      for (std::size_t i = 0; i < techniques.size(); ++i)
        images[v][i].push_back(
            grey(bdpt_tool::read_technique(job.film(), techniques[i].first, techniques[i].second, false)));
      if (turn == 0) inner[v] = bdpt_tool::read_technique(job.film(), 2, 2, false);
    }
  Table table{
      "Relative variance for the same samples, BDPT / matrix", {"k", "s = 1", "s = 2", "s = 3", "s = 4", "s = 5"}, {}};
  Job whole(stage, bidirectional(), edges, turns + 1, edges);
  whole.advance(passes * turns);
  std::size_t inside = 0, wins = 0, ends = 0, ties = 0;
  for (std::size_t i = 0; i < techniques.size(); ++i) {
    const auto [s, t] = techniques[i];
    if (s == 1) table.rows.push_back({double(s + t - 1)});
    const auto reference = reference_of({grey(bdpt_tool::read_technique(whole.film(), s, t, false))});
    const Estimate ratio = jackknife(turns, [&](std::size_t without) {
      return relative_variance(images[0][i], without, reference) / relative_variance(images[1][i], without, reference);
    });
    table.rows.back().push_back(ratio);
    if (s > 1 && t > 1)
      ++inside, wins += above(ratio, 1);
    else if (t == 1)
      ++ends, ties += ratio.value > 0.9 && ratio.value < 1.1;
  }
  for (auto& row : table.rows) row.resize(table.columns.size(), std::string());
  report.measured(
      "A Cornell box, paths of up to 5 edges, independent points; the last entry of a row is t = 1. The matrix plan "
      "took " +
      text(Estimate{spent[1] / spent[0], 0}) + " times the time of BDPT.");
  report.add(std::move(table));
  report.compare("(2,2) alone", "BDPT", inner[0], "matrix", inner[1], stage.exposure + 1);
  report.verdict(wins == inside && ties == ends ? Verdict::Agrees
                 : wins > 0                     ? Verdict::Partly
                                                : Verdict::Differs,
                 "Matrix wins in " + std::to_string(wins) + " of " + std::to_string(inside) +
                     " techniques with s ≥ 2 and t ≥ 2; at t = 1 it ties in " + std::to_string(ties) + " of " +
                     std::to_string(ends) + ".");
}

void matrix_door(Report& report) {
  const Setting& setting = report.setting();
  SceneDescription scene = bitterli_scene(setting, "veach-ajar");
  add_unreachable_emitters(scene);
  const Stage stage = build_stage(std::move(scene), setting.pick(480, 96, 24), setting, 1);
  report.measured(
      "Bitterli's door ajar; ten copies of its lamp in closed boxes take ten of eleven light subpaths. Paths "
      "of up to 6 edges.");
  judge_faster(report, converge(report, stage, 6));
}

void matrix_houses(Report& report) {
  const Setting& setting = report.setting();
  const Stage stage = build_stage(stacked_houses(), setting.pick(480, 96, 24), setting, 0.5f);
  report.measured("Eleven houses of three closed rooms, a lamp in each; one room is seen. Paths of up to 6 edges.");
  judge_faster(report, converge(report, stage, 6));
}

void matrix_egg_room(Report& report) {
  const Setting& setting = report.setting();
  const Stage stage = build_stage(bitterli_scene(setting, "veach-bidir"), setting.pick(400, 80, 24), setting);
  report.measured("Paths of up to 6 edges.");
  const Outcome outcome = converge(report, stage, 6);
  const Estimate& ratio = outcome.over_bdpt;
  const bool par = ratio.value > 0.8 && ratio.value < 1.25;
  const bool other = below(ratio, 0.8) || above(ratio, 1.25);
  report.verdict(par     ? Verdict::Agrees
                 : other ? Verdict::Differs
                         : Verdict::Open,
                 "Matrix has " + text(ratio) + " times the efficiency of BDPT." + outcome.others);
}

void matrix_connections(Report& report) {
  const Setting& setting = report.setting();
  const Stage stage = build_stage(bathroom(), setting.pick(480, 80, 24), setting, 1);
  ContestOptions options;
  options.max_edges = 6;
  options.passes = setting.pick(64, 32, 8);
  options.turns = setting.pick(16, 4, 2);
  std::vector<Variant> variants = {matrix(1), matrix(2), matrix(4), matrix(8), bidirectional()};
  for (Variant& variant : variants) variant = independent(variant);
  const auto contestants = hold(stage, variants, options);
  report.measured("A bathroom built for this, paths of up to 6 edges, independent points.");
  report.add(contest_table("The same time", contestants));
  report.compare("In the same time", label(contestants[0]), contestants[0].picture, label(contestants[3]),
                 contestants[3].picture, stage.exposure);
  const Estimate last = efficiency_ratio(contestants[3].end(), contestants[0].end());
  bool falls = true;
  for (std::size_t i = 1; i < 4; ++i)
    falls = falls && efficiency_ratio(contestants[i].end(), contestants[i - 1].end()).value < 1;
  report.verdict(falls            ? Verdict::Agrees
                 : below(last, 1) ? Verdict::Partly
                                  : Verdict::Differs,
                 "With m = 8 the efficiency is " + text(last) + " times that of m = 1" +
                     (falls ? ", and it falls with each step." : "; it does not fall with each step."));
}

}  // namespace bdpt_experiments
