// Brown (2011), two-way path tracing.
//
// SPDX-License-Identifier: Apache-2.0
#include "film_output.h"
#include "rows/rows.h"
#include "scenes/scenes.h"
#include "tables.h"

namespace bdpt_experiments {
namespace {

// Half as many two-way samples as samples of eye and of light paths: as many paths.
void compare_ways(Report& report, SceneDescription scene, float exposure) {
  const Setting& setting = report.setting();
  const Stage stage = build_stage(std::move(scene), setting.pick(480, 128, 24), setting, exposure);
  ContestOptions options;
  options.max_edges = 6;
  options.passes = setting.pick(64, 24, 2);
  options.turns = setting.pick(16, 4, 2);
  const auto contestants = hold(stage, {of_plan("two-way"), bidirectional(), light_tracing(), path_tracing()}, options);
  const Contestant &two_way = contestants[0], &bdpt = contestants[1], &light = contestants[2], &path = contestants[3];
  report.add(contest_table("The same time", contestants));
  report.compare("Two-way and path tracing", label(two_way), two_way.picture, label(path), path.picture, exposure);
  report.compare("Two-way and light tracing", label(two_way), two_way.picture, label(light), light.picture, exposure);
  const double cost =
      seconds(two_way.end()) / double(two_way.end().passes) /
      (seconds(path.end()) / double(path.end().passes) + seconds(light.end()) / double(light.end().passes));
  const Estimate gain = efficiency_ratio(two_way.end(), path.end()),
                 over_bdpt = efficiency_ratio(two_way.end(), bdpt.end());
  report.verdict(above(gain, 2) && cost < 1.25 ? Verdict::Agrees
                 : above(gain, 1)              ? Verdict::Partly
                 : below(gain, 1)              ? Verdict::Differs
                                               : Verdict::Open,
                 "Two-way has " + text(gain) + " times the efficiency of path tracing and " + text(over_bdpt) +
                     " times that of BDPT; its sample costs " + text(Estimate{cost, 0}) +
                     " times a path tracing sample and a light tracing sample together.");
}

}  // namespace

void two_way_spheres(Report& report) {
  report.measured(
      "Spheres on a floor as Brown describes them, paths of up to 6 edges. Light tracing cannot show mirror "
      "and glass themselves, so that its relative variance tells little.");
  compare_ways(report, brown_spheres(), 0);
}

void two_way_meshes(Report& report) {
  report.measured(
      "For Brown's Buddha, dragon and bunny stand a torus of rough metal (for Phong), a ball with bumps "
      "(mirror) and a knot (glass). Paths of up to 6 edges.");
  compare_ways(report, brown_meshes(), 0);
}

void two_way_lightmap(Report& report) {
  const Setting& setting = report.setting();
  constexpr std::uint32_t kEdges = 4;
  const Stage stage =
      build_lightmap(cornell_box(BoxContents::GlassSphere, BoxLight::Down), setting.pick(256, 128, 16), setting, -2);
  const std::uint64_t passes = setting.pick(512, 64, 2);
  const Variant two_way = of_plan("two-way");
  Job job(stage, two_way, kEdges, 1, kEdges);
  job.advance(passes);
  report.picture("The floor as a lightmap", job.color(), stage.exposure);
  report.pyramid("Two-way: from left to right s = 0, 1, k, k + 1; (0,k+1) hits the lamp, (k+1,0) the lightmap",
                 job.film(), true, true, stage.exposure);
  Table table{
      "Share of each technique in the light of all paths of its length", {"k", "s = 0", "s = 1", "t = 1", "t = 0"}, {}};
  bool all = true;
  for (std::uint32_t k = 1; k <= kEdges; ++k) {
    const auto sum = [&](std::uint32_t s) {
      double total = 0;
      for (const float x : bdpt_tool::read_technique(job.film(), s, k + 1 - s, false).pixels) total += x;
      return total;
    };
    // (1,1) is both s = 1 and t = 1.
    const double s0 = sum(0), s1 = sum(1), t1 = k > 1 ? sum(k) : 0, t0 = sum(k + 1), whole = s0 + s1 + t1 + t0;
    table.rows.push_back(
        {double(k), s0 / whole, s1 / whole, k > 1 ? Cell(t1 / whole) : Cell(std::string("–")), t0 / whole});
    all = all && s0 > 0 && s1 > 0 && (k == 1 || t1 > 0) && t0 > 0;
  }
  ContestOptions options;
  options.max_edges = kEdges;
  options.passes = setting.pick(64, 16, 2);
  options.turns = setting.pick(32, 24, 3);  // so that the differences of means are all but normal
  Variant landing = two_way;
  landing.name = "light tracing alone", landing.techniques = "t=0";
  const auto contestants = hold(stage, {two_way, landing, eye_only()}, options);
  report.measured("The floor itself is the sensor: a texel measures the light it receives, and light subpaths hit it.");
  report.add(std::move(table));
  report.add(contest_table("The same time", contestants));
  const Checkpoint &both = contestants[0].end(), &light = contestants[1].end(), &eye = contestants[2].end();
  report.compare("The lightmap in the same time", label(contestants[0]), contestants[0].picture, label(contestants[2]),
                 contestants[2].picture, stage.exposure);
  Table agreement{"Texels whose means differ by more than so many standard errors of their difference, in per cent",
                  {"", "2", "3", "mean / two-way"},
                  {}};
  const auto compare = [&](const char* name, const Checkpoint& a, const Checkpoint& b) {
    agreement.rows.push_back({std::string(name), 100 * apart(a, b, 2), 100 * apart(a, b, 3), mean_ratio(a, both)});
  };
  compare("two-way and light alone", light, both);
  compare("two-way and eye-only", eye, both);
  compare("light alone and eye-only", eye, light);
  report.add(std::move(agreement));
  report.verdict(all ? Verdict::Agrees : Verdict::Differs,
                 std::string(all ? "All techniques of each length carry light" : "Some techniques carry no light") +
                     "; the mean of the map is " + text(mean(both)) + ", by light alone " + text(mean(light)) +
                     ", by eye-only " + text(mean(eye)) + ".");
}

}  // namespace bdpt_experiments
