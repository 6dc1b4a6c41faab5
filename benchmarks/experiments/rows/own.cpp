// What no paper has: costs that grow, and every plan on every scene.
//
// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "rows/rows.h"
#include "scenes/scenes.h"
#include "tables.h"

namespace bdpt_experiments {
namespace {

// Microseconds of a sample, over renders with seeds of their own.
Estimate sample_cost(const Stage& stage, const Variant& variant, std::uint32_t max_edges, std::uint64_t passes,
                     std::size_t turns, bool of_the_wall = false) {
  std::vector<double> costs;
  for (std::size_t turn = 0; turn < turns; ++turn) {
    Job job(stage, variant, max_edges, turn + 1);
    job.advance(passes_at_once(variant));  // warms up
    const double before = job.stats().seconds, samples = double(job.stats().samples);
    const double spent = job.advance(passes);
    costs.push_back(1e6 * (of_the_wall ? job.stats().seconds - before : spent) /
                    (double(job.stats().samples) - samples));
  }
  return jackknife(turns, [&](std::size_t without) {
    double sum = 0;
    for (std::size_t i = 0; i < turns; ++i)
      if (i != without) sum += costs[i];
    return sum / double(turns - (without < turns ? 1 : 0));
  });
}

// Of a third of the machine's memory, at 150 bytes each.
std::uint64_t triangles_that_fit() {
  return std::uint64_t(sysconf(_SC_PHYS_PAGES)) * std::uint64_t(sysconf(_SC_PAGESIZE)) / 3 / 150;
}

constexpr const char* kCost = "µs a sample";

}  // namespace

void own_lights(Report& report) {
  const Setting& setting = report.setting();
  Table table{"BDPT in a hall of lamps, all of the same power together",
              {"lamps", "build, s", kCost, "relative variance at 8 samples a pixel"},
              {}};
  Plot plot{"Cost", "lamps", kCost, {{"BDPT", {}, {}}}};
  std::vector<double> cost;
  for (int count = 1; count <= 10000; count *= 10) {
    const Stage stage = build_stage(lamp_hall(count), setting.pick(320, 120, 24), setting);
    const Estimate each = sample_cost(stage, bidirectional(), 5, setting.pick(16, 8, 1), setting.pick(8, 3, 2));
    ContestOptions options;
    options.max_edges = 5;
    options.passes = 8;
    options.turns = setting.pick(16, 4, 2);
    options.equal_time = false;
    const auto contest = hold(stage, {bidirectional()}, options);
    table.rows.push_back({double(count), stage.build_seconds, each, relative_variance(contest[0].end())});
    plot.series[0].x.push_back(count), plot.series[0].y.push_back(each);
    cost.push_back(each.value);
    if (count == 100) report.picture("100 lamps, " + label(contest[0]), contest[0].picture, stage.exposure);
  }
  report.add(std::move(table));
  report.add(std::move(plot));
  report.verdict(Verdict::Told, "A sample under 10,000 lamps costs " + text(Estimate{cost.back() / cost.front(), 0}) +
                                    " times one under a single lamp.");
}

void own_triangles(Report& report) {
  const Setting& setting = report.setting();
  Table table{"BDPT over a waved field", {"triangles", "build, s", "memory, MB", kCost}, {}};
  Plot plot{"Cost", "triangles", kCost, {{"BDPT", {}, {}}}};
  std::vector<double> cost;
  const std::uint64_t most = std::min(setting.pick<std::uint64_t>(50'000'000, 1'000'000, 20'000), triangles_that_fit());
  for (std::uint64_t count : {10'000ull, 100'000ull, 1'000'000ull, 10'000'000ull, 50'000'000ull}) {
    if (count > most) break;
    const Stage stage = build_stage(triangle_field(count), setting.pick(320, 160, 24), setting);
    auto info = bdpt_tool::sized<bdpt_scene_info>();
    bdpt_tool::check(bdpt_scene_get_info(stage.scene.get(), &info), "the scene");
    const Estimate each = sample_cost(stage, bidirectional(), 5, setting.pick(16, 8, 1), setting.pick(8, 3, 2));
    table.rows.push_back({double(info.triangles), stage.build_seconds, double(info.memory) / 1e6, each});
    plot.series[0].x.push_back(double(info.triangles)), plot.series[0].y.push_back(each);
    cost.push_back(each.value);
  }
  report.add(std::move(table));
  report.add(std::move(plot));
  report.verdict(Verdict::Told, "From the smallest field to the largest a sample's cost grows " +
                                    text(Estimate{cost.back() / cost.front(), 0}) + " times.");
}

void own_pixels(Report& report) {
  const Setting& setting = report.setting();
  Table table{"A Cornell box, paths of up to 5 edges", {"pixels", "BDPT, µs a sample", "matrix, µs a sample"}, {}};
  Plot plot{"Cost", "pixels", kCost, {{"BDPT", {}, {}}, {"matrix", {}, {}}}};
  double low = INFINITY, high = 0;
  for (std::uint32_t width = 32; width <= setting.pick(2048u, 256u, 32u); width *= 2) {
    const Stage stage = build_stage(cornell_box(BoxContents::MirrorAndGlass, BoxLight::Down), width, setting);
    const std::uint64_t passes = std::max<std::uint64_t>(1, setting.pick(64, 16, 1) * 128 * 128 / (width * width)) * 8;
    const std::size_t turns = setting.pick(5, 2, 2);
    const Estimate bdpt = sample_cost(stage, bidirectional(), 5, std::min<std::uint64_t>(passes, 256), turns);
    const Estimate matrix = sample_cost(stage, of_plan("matrix"), 5, std::min<std::uint64_t>(passes, 256), turns);
    table.rows.push_back({double(width) * width, bdpt, matrix});
    for (int i = 0; i < 2; ++i) {
      plot.series[std::size_t(i)].x.push_back(double(width) * width);
      plot.series[std::size_t(i)].y.push_back(i ? matrix : bdpt);
    }
    low = std::min(low, bdpt.value), high = std::max(high, bdpt.value);
  }
  report.add(std::move(table));
  report.add(std::move(plot));
  report.verdict(Verdict::Told, "Between the cheapest and the dearest size lies a factor of " +
                                    text(Estimate{high / low, 0}) + " for a sample of BDPT.");
}

void own_threads(Report& report) {
  Setting setting = report.setting();
  Stage all = build_stage(cornell_box(BoxContents::MirrorAndGlass, BoxLight::Down), 16, setting);
  const std::uint32_t most = all.threads;
  Table table{"Seconds of the wall for a sample, one thread over n", {"threads", "BDPT", "matrix", "path tracing"}, {}};
  const Variant variants[] = {bidirectional(), of_plan("matrix"), path_tracing()};
  std::vector<double> one;
  double last = 1;
  for (std::uint32_t threads = 1; threads <= most;
       threads = threads < most && threads * 2 > most ? most : threads * 2) {
    setting.threads = threads;
    const Stage stage =
        build_stage(cornell_box(BoxContents::MirrorAndGlass, BoxLight::Down), setting.pick(320, 160, 24), setting);
    table.rows.push_back({double(threads)});
    for (std::size_t v = 0; v < 3; ++v) {
      const Estimate cost = sample_cost(stage, variants[v], 5, setting.pick(32, 8, 8), setting.pick(8, 3, 2), true);
      if (threads == 1) one.push_back(cost.value);
      table.rows.back().push_back(Estimate{one[v] / cost.value, one[v] / cost.value * cost.error / cost.value});
      if (v == 0) last = one[0] / cost.value;
    }
  }
  report.measured("The only row in which seconds are those of the wall: it says nothing on a machine that is busy.");
  report.add(std::move(table));
  report.verdict(Verdict::Told, "On " + std::to_string(most) + " threads BDPT is " + text(Estimate{last, 0}) +
                                    " times as fast as on one.");
}

void own_length(Report& report) {
  const Setting& setting = report.setting();
  const Variant variants[] = {path_tracing(), of_plan("two-way"), bidirectional(), of_plan("matrix")};
  Table table{"A Cornell box, µs a sample", {"k at most"}, {}};
  Plot plot{"Cost", "longest path, edges", kCost, {}};
  for (const Variant& variant : variants) {
    table.columns.push_back(variant.name);
    plot.series.push_back({variant.name, {}, {}});
  }
  const Stage stage =
      build_stage(cornell_box(BoxContents::MirrorAndGlass, BoxLight::Down), setting.pick(256, 96, 16), setting);
  for (const std::uint32_t edges : {2u, 3u, 4u, 6u, 8u, 12u, 20u}) {
    table.rows.push_back({double(edges)});
    for (std::size_t v = 0; v < 4; ++v) {
      const Estimate cost = sample_cost(stage, variants[v], edges, setting.pick(32, 8, 8), setting.pick(5, 2, 2));
      table.rows.back().push_back(cost);
      plot.series[v].x.push_back(edges), plot.series[v].y.push_back(cost);
    }
  }
  const auto cost = [&](std::size_t row) { return std::get<Estimate>(table.rows[row][3]).value; };
  report.verdict(Verdict::Told, "A sample of BDPT with paths of up to 20 edges costs " +
                                    text(Estimate{cost(6) / cost(3), 0}) + " times one of up to 6.");
  report.add(std::move(table));
  report.add(std::move(plot));
}

namespace {

std::string chosen(const bdpt_render_stats& stats) {
  const std::pair<const char*, float> shares[] = {{"path tracing", stats.share_path},
                                                  {"two-way", stats.share_two_way},
                                                  {"one-to-one", stats.share_one_to_one},
                                                  {"matrix", stats.share_matrix}};
  std::string words;
  for (const auto& [name, share] : shares)
    if (share >= 0.005f) words += (words.empty() ? "" : ", ") + std::to_string(std::lround(100 * share)) + " % " + name;
  return words + "; n = " + std::to_string(stats.light_samples);
}

// A contest on a scene, paths of up to 6 edges; none where the scene is missing, which the report then says.
std::vector<Contestant> hold_on(Report& report, const NamedScene& scene, std::uint32_t width,
                                const std::vector<Variant>& variants, std::uint64_t passes, std::size_t turns) {
  try {
    const Stage stage = build_stage(scene.make(), width, report.setting());
    ContestOptions options;
    options.max_edges = 6;
    options.passes = passes;
    options.turns = turns;
    return hold(stage, variants, options);
  } catch (const SceneMissing& missing) {
    report.note(std::string(missing.what()) + ", and is left out.");
    return {};
  }
}

}  // namespace

void own_plans(Report& report) {
  const Setting& setting = report.setting();
  std::vector<Variant> variants = {bidirectional(), path_tracing(), light_tracing()};
  for (std::uint32_t i = 1; bdpt_plan_name(i); ++i) variants.push_back(of_plan(bdpt_plan_name(i)));
  Table table{"Efficiency over that of BDPT; the best of each scene is named last", {"scene"}, {}};
  for (std::size_t v = 1; v < variants.size(); ++v) table.columns.push_back(variants[v].name);
  table.columns.push_back("best");
  std::vector<std::size_t> wins(variants.size());
  for (const NamedScene& scene : scenes_of_the_table(setting)) {
    const auto contestants =
        hold_on(report, scene, setting.pick(240, 48, 16), variants, setting.pick(32, 8, 1), setting.pick(12, 4, 2));
    if (contestants.empty()) continue;
    table.rows.push_back({std::string(scene.name)});
    double best = 1;
    std::size_t winner = 0;
    for (std::size_t v = 1; v < contestants.size(); ++v) {
      const Estimate ratio = efficiency_ratio(contestants[v].end(), contestants[0].end());
      table.rows.back().push_back(ratio);
      // What light tracing cannot see at all has no variance: a tenth of the light missing rules it out.
      const double light = mean(contestants[v].end()).value / mean(contestants[0].end()).value;
      if (above(ratio, 1) && ratio.value > best && light > 0.9) best = ratio.value, winner = v;
    }
    table.rows.back().push_back(variants[winner].name);
    ++wins[winner];
  }
  std::string words;
  for (std::size_t v = 0; v < variants.size(); ++v)
    if (wins[v]) words += (words.empty() ? "" : ", ") + variants[v].name + " in " + std::to_string(wins[v]);
  report.measured(
      "Paths of up to 6 edges, each plan as it is by default, in the same time. Light tracing does not see "
      "mirrors and glass: its figure counts where it carries nine tenths of the light.");
  report.add(std::move(table));
  report.verdict(Verdict::Told, "Best of all: " + words + " of the scenes.");
}

void own_automatic(Report& report) {
  const Setting& setting = report.setting();
  const std::vector<Variant> variants = {bidirectional(), path_tracing(), of_plan("two-way"), of_plan("matrix"),
                                         of_plan("automatic")};
  Table table{"Efficiency over that of BDPT, and of the automatic plan over the best",
              {"scene", "path tracing", "two-way", "matrix", "automatic", "over the best", "its choice"},
              {}};
  std::size_t reached = 0, unclear = 0;
  std::string missed;
  for (const NamedScene& scene : scenes_of_the_table(setting)) {
    const auto contestants =
        hold_on(report, scene, setting.pick(160, 64, 16), variants, setting.pick(32, 16, 8), setting.pick(8, 5, 2));
    if (contestants.empty()) continue;
    table.rows.push_back({std::string(scene.name)});
    std::size_t best = 0;
    for (std::size_t v = 1; v < variants.size(); ++v) {
      table.rows.back().push_back(efficiency_ratio(contestants[v].end(), contestants[0].end()));
      if (v + 1 < variants.size() && efficiency_ratio(contestants[v].end(), contestants[best].end()).value > 1)
        best = v;
    }
    const Estimate over = efficiency_ratio(contestants.back().end(), contestants[best].end());
    table.rows.back().push_back(over);
    table.rows.back().push_back(chosen(contestants.back().stats));
    if (over.value >= 0.95)
      ++reached;
    else if (below(over, 0.95))
      missed += (missed.empty() ? "" : ", ") + std::string(scene.name);
    else
      ++unclear;
  }
  report.measured(
      "Paths of up to 6 edges, in the same time, the pilot's among it. To reach 0.95 of the best is the aim.");
  const std::size_t scenes = table.rows.size();
  report.add(std::move(table));
  report.verdict(missed.empty() ? Verdict::Agrees : Verdict::Partly,
                 "In " + std::to_string(reached) + " of " + std::to_string(scenes) +
                     " scenes the automatic plan has 0.95 of the best plan's efficiency or more; in " +
                     std::to_string(unclear) + " that is within the noise" +
                     (missed.empty() ? "." : "; it has less in: " + missed + "."));
}

void own_adaptive(Report& report) {
  const Setting& setting = report.setting();
  const NamedScene scenes[] = {
      {"Cornell box", [] { return cornell_box(BoxContents::Boxes, BoxLight::Down); }},
      {"egg room", [&] { return bitterli_scene(setting, "veach-bidir"); }},
      {"door ajar", [&] { return bitterli_scene(setting, "veach-ajar"); }},
      {"plates and lamps", [&] { return bitterli_scene(setting, "veach-mis"); }},
  };
  Table table{"Adaptive over uniform, in the same time", {"scene"}, {}};
  std::vector<Variant> variants;
  for (const Variant& uniform : {bidirectional(), path_tracing()}) {
    Variant adaptive = uniform;
    adaptive.name += ", adaptive", adaptive.adaptive = BDPT_ADAPTIVE_TWO_STAGES;
    variants.insert(variants.end(), {uniform, adaptive});
    table.columns.insert(table.columns.end(),
                         {uniform.name + ": variance", adaptive.name + ": variance", "efficiency"});
  }
  std::size_t better = 0, worse = 0;
  for (const NamedScene& scene : scenes) {
    const auto contestants =
        hold_on(report, scene, setting.pick(400, 192, 24), variants, setting.pick(32, 16, 2), setting.pick(16, 6, 2));
    if (contestants.empty()) continue;
    table.rows.push_back({std::string(scene.name)});
    for (std::size_t v = 0; v < variants.size(); v += 2) {
      const Checkpoint &uniform = contestants[v].end(), &adaptive = contestants[v + 1].end();
      const Estimate ratio = efficiency_ratio(adaptive, uniform);
      table.rows.back().insert(table.rows.back().end(),
                               {relative_variance(uniform), relative_variance(adaptive), ratio});
      better += above(ratio, 1), worse += below(ratio, 1);
    }
  }
  report.measured("Paths of up to 6 edges. The pilot's rays are part of the time.");
  report.verdict(Verdict::Told, "Of " + std::to_string(2 * table.rows.size()) + " pairs " + std::to_string(better) +
                                    " gain by it and " + std::to_string(worse) + " lose.");
  report.add(std::move(table));
}

void own_light_start(Report& report) {
  const Setting& setting = report.setting();
  const NamedScene scenes[] = {
      {"door ajar, ten lamps in vain",
       [&] {
         SceneDescription scene = bitterli_scene(setting, "veach-ajar");
         add_unreachable_emitters(scene);
         return scene;
       }},
      {"stacked houses", [] { return stacked_houses(); }},
      {"egg room", [&] { return bitterli_scene(setting, "veach-bidir"); }},
      {"hall of 100 lamps", [] { return lamp_hall(100); }},
      {"hall of 10,000 lamps", [] { return lamp_hall(10000); }},
  };
  std::vector<Variant> variants;
  for (const char* plan : {"one-to-one", "pooled", "matrix"})
    for (const bool importance : {false, true}) {
      variants.push_back(of_plan(plan));
      if (!importance) continue;
      variants.back().name += ", importance";
      variants.back().light_start = BDPT_LIGHT_START_IMPORTANCE;
    }
  Table table{"By importance over by power", {"scene"}, {}};
  for (std::size_t v = 0; v < variants.size(); v += 2)
    for (const char* what : {": efficiency", ": at the same samples"}) table.columns.push_back(variants[v].name + what);
  std::size_t better = 0, worse = 0;
  for (const NamedScene& scene : scenes) {
    const auto contestants =
        hold_on(report, scene, setting.pick(320, 96, 16), variants, setting.pick(64, 32, 8), setting.pick(16, 6, 2));
    if (contestants.empty()) continue;
    table.rows.push_back({std::string(scene.name)});
    for (std::size_t v = 0; v < contestants.size(); v += 2) {
      const Checkpoint &power = contestants[v].end(), &importance = contestants[v + 1].end();
      const Estimate ratio = efficiency_ratio(importance, power);
      table.rows.back().push_back(ratio);
      table.rows.back().push_back(sample_ratio(importance, power));
      better += above(ratio, 1), worse += below(ratio, 1);
    }
  }
  report.measured("Paths of up to 6 edges; the pilot's time is not in the efficiency: it is that of one short pass.");
  report.add(std::move(table));
  report.verdict(Verdict::Told, "Better in " + std::to_string(better) + " of " + std::to_string(3 * std::size(scenes)) +
                                    " contests, worse in " + std::to_string(worse) + ".");
}

void own_pool(Report& report) {
  const Setting& setting = report.setting();
  const NamedScene scenes[] = {
      {"egg room", [&] { return bitterli_scene(setting, "veach-bidir"); }},
      {"door ajar", [&] { return bitterli_scene(setting, "veach-ajar"); }},
      {"Cornell box, glass sphere", [] { return cornell_box(BoxContents::GlassSphere, BoxLight::Down); }},
  };
  // Each plan as it is, and then its options, one by one.
  std::vector<Variant> variants;
  std::vector<std::size_t> base;
  const auto add = [&](const std::string& plan, std::uint32_t connections, bool importance, bool aware) {
    Variant variant = of_plan(plan);
    variant.connections = connections;
    if (connections) variant.name += ", m = " + std::to_string(connections);
    if (importance) variant.name += ", importance", variant.pool_selection = BDPT_POOL_SELECTION_IMPORTANCE;
    if (aware) variant.name += ", aware", variant.correlation_aware = true;
    if (!importance && !aware) base.push_back(variants.size());
    variants.push_back(variant);
  };
  add("pooled", 2, false, false), add("pooled", 2, true, false);
  add("pooled", 32, false, false), add("pooled", 32, true, false), add("pooled", 32, false, true);
  add("combinatorial", 0, false, false), add("combinatorial", 0, false, true);
  Table table{"Over the plan without the option", {"option"}, {}};
  for (const NamedScene& scene : scenes)
    for (const char* what : {": efficiency", ": at the same samples"})
      table.columns.push_back(scene.name + std::string(what));
  for (const Variant& variant : variants)
    if (variant.pool_selection || variant.correlation_aware) table.rows.push_back({variant.name});
  std::size_t better = 0, worse = 0;
  for (const NamedScene& scene : scenes) {
    std::size_t row = 0;
    try {
      const Stage stage = build_stage(scene.make(), setting.pick(240, 64, 16), setting);
      for (std::size_t b = 0; b < base.size(); ++b) {
        const std::size_t end = b + 1 < base.size() ? base[b + 1] : variants.size();
        ContestOptions options;
        options.max_edges = 6;
        options.passes = setting.pick(32, 16, 2);
        options.turns = setting.pick(16, 8, 2);
        const std::vector<Variant> own(variants.begin() + std::ptrdiff_t(base[b]),
                                       variants.begin() + std::ptrdiff_t(end));
        const auto contestants = hold(stage, own, options);
        for (std::size_t v = 1; v < contestants.size(); ++v, ++row) {
          const Estimate ratio = efficiency_ratio(contestants[v].end(), contestants[0].end());
          table.rows[row].push_back(ratio);
          table.rows[row].push_back(sample_ratio(contestants[v].end(), contestants[0].end()));
          better += above(ratio, 1), worse += below(ratio, 1);
        }
      }
    } catch (const SceneMissing& missing) {
      report.note(std::string(missing.what()) + ", and is left out.");
      for (auto& cells : table.rows) cells.push_back(std::string("-")), cells.push_back(std::string("-"));
    }
  }
  report.measured("Paths of up to 6 edges; in the same time, and for the same number of samples.");
  report.verdict(Verdict::Told, "Better in " + std::to_string(better) + " of " +
                                    std::to_string(table.rows.size() * std::size(scenes)) + " contests, worse in " +
                                    std::to_string(worse) + ".");
  report.add(std::move(table));
}

}  // namespace bdpt_experiments
