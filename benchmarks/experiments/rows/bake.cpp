// Lightmaps: what bakers that trace from the texel alone pay for light that they find by chance.
//
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>

#include "rows/rows.h"
#include "scenes/scenes.h"
#include "tables.h"

namespace bdpt_experiments {
namespace {

constexpr std::uint32_t kEdges = 6;

struct Room {
  BakedRoom room;
  const char* name;
  double target;  // of the best plan's efficiency over that of eye-only baking; 0 = the automatic plan's, 0.95
};
const Room kRooms[] = {{BakedRoom::Gap, "light through a gap", 5},
                       {BakedRoom::GlassSphere, "a glass sphere's caustic", 50},
                       {BakedRoom::Plain, "a wide lamp", 0}};

// Pools of one pass where there are few passes.
ContestOptions options_for(std::uint32_t side, const Setting& setting, std::vector<Variant>& variants) {
  ContestOptions options;
  options.max_edges = kEdges;
  const std::uint64_t texels = std::uint64_t(side) * side, samples = setting.pick(1 << 21, 1 << 18, 1 << 9);
  options.passes = std::max<std::uint64_t>(samples / texels, 1);
  options.turns = setting.pick(side > 256 ? 3 : 6, 6, 3);
  if (options.passes < 32)
    for (Variant& v : variants)
      if (passes_at_once(v) > 1) v.pool_passes = 1;
  return options;
}

// The texels brighter than twice the median: a caustic.
std::vector<std::size_t> bright_texels(const bdpt_benchmark::ImageVariance& map) {
  std::vector<double> values;
  for (std::size_t i = 0; i < map.pixels(); ++i) values.push_back(map.mean(i));
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  const double limit = 2 * values[values.size() / 2];
  std::vector<std::size_t> bright;
  for (std::size_t i = 0; i < map.pixels(); ++i)
    if (map.mean(i) > limit) bright.push_back(i);
  return bright;
}

// A look at some of the texels alone.
Checkpoint part_of(const Checkpoint& whole, const std::vector<std::size_t>& texels) {
  const auto pick = [&](const auto& value) {
    std::vector<float> values;
    for (const std::size_t i : texels) values.push_back(float(value(i)));
    return values;
  };
  Checkpoint part{whole.passes, whole.seconds, {}, nullptr};
  for (const auto& image : whole.images) part.images.push_back(pick([&](std::size_t i) { return image[i]; }));
  const auto mean = pick([&](std::size_t i) { return whole.reference->mean(i); });
  part.reference = std::make_shared<const bdpt_benchmark::ImageVariance>(reference_of({mean}));
  return part;
}

Table caustic_table(const std::vector<Contestant>& contestants) {
  const Checkpoint& eye = contestants.back().end();
  const std::vector<std::size_t> texels = bright_texels(*eye.reference);
  Table table{"The caustic alone: " + std::to_string(100 * texels.size() / eye.reference->pixels()) +
                  " % of the texels, brighter than twice the median",
              {"plan", "relative variance", "efficiency / eye-only"},
              {}};
  if (texels.empty()) return table;
  const Checkpoint eye_part = part_of(eye, texels);
  for (const Contestant& c : contestants) {
    const Checkpoint part = part_of(c.end(), texels);
    table.rows.push_back({c.variant.name, relative_variance(part),
                          &c == &contestants.back() ? Cell("1") : Cell(efficiency_ratio(part, eye_part))});
  }
  return table;
}

double samples_per_second(std::uint32_t side, std::uint64_t passes, double processor_seconds) {
  return double(passes) * side * side / processor_seconds;
}

// A large map, once: what a sample costs there.
void add_large(Table& table, BakedRoom room, std::uint32_t side, std::vector<Variant> variants,
               const Setting& setting) {
  const Stage stage = build_lightmap(baked_room(room), side, setting);
  options_for(side, setting, variants);
  for (const Variant& variant : variants) {
    Job job(stage, variant, kEdges, 1);
    const double spent = job.advance(passes_at_once(variant)) * stage.threads;
    table.rows.push_back({double(side), variant.name, samples_per_second(side, passes_at_once(variant), spent),
                          std::string("-"), std::string("-"), std::string("-")});
  }
}

}  // namespace

void own_bake(Report& report) {
  const Setting& setting = report.setting();
  std::vector<std::uint32_t> sides = {256, 1024};
  if (setting.size == Size::Quick) sides = {64, 256};
  if (setting.size == Size::Tiny) sides = {8};
  report.measured(
      "The floor of a closed room by texels, diffuse walls of reflectance 0.6, paths of up to 6 edges, all plans in "
      "the "
      "same processor time. Eye-only is path tracing from the texel with direct lighting, weighted by MIS. Samples are "
      "counted for a second of one processor.");
  Variant two = of_plan("two-way");
  two.name = "two-way, 2 light subpaths", two.light_samples = 2;
  const std::vector<Variant> plans = {
      of_plan("two-way"), two, bidirectional(), of_plan("pooled"), of_plan("matrix"), of_plan("automatic"), eye_only()};
  std::string text;
  bool good = true;
  for (const Room& room : kRooms) {
    Table table{std::string("The floor: ") + room.name,
                {"texels a side", "plan", "texel samples / s", "relative variance", "efficiency / eye-only",
                 "time to equal variance / eye-only"},
                {}};
    for (const std::uint32_t side : sides) {
      const Stage stage = build_lightmap(baked_room(room.room), side, setting);
      std::vector<Variant> variants = plans;
      const ContestOptions options = options_for(side, setting, variants);
      const auto contestants = hold(stage, variants, options);
      const Checkpoint& eye = contestants.back().end();
      double best = 0;
      for (const Contestant& c : contestants) {
        const bool own = &c.end() == &eye;
        const Estimate gain = efficiency_ratio(c.end(), eye),
                       time{1 / gain.value, gain.error / (gain.value * gain.value)};
        table.rows.push_back({double(side), c.variant.name,
                              samples_per_second(side, c.end().passes, seconds(c.end()) * stage.threads),
                              relative_variance(c.end()), own ? Cell("1") : Cell(gain), own ? Cell("1") : Cell(time)});
        if ((room.target == 0) == (c.variant.plan == "automatic")) best = std::max(best, gain.value);
      }
      if (side != sides.front()) continue;
      if (room.room == BakedRoom::GlassSphere) report.add(caustic_table(contestants));
      good = good && best >= (room.target > 0 ? room.target : 0.95);
      text += std::string(text.empty() ? "" : "; ") + room.name + ": " +
              (room.target > 0 ? "the best plan has " : "automatic has ") + bdpt_experiments::text(Estimate{best, 0}) +
              " times the efficiency of eye-only baking";
      report.compare(room.name, label(contestants.front()), contestants.front().picture, label(contestants.back()),
                     contestants.back().picture, 0);
    }
    if (setting.size == Size::Full && room.room == BakedRoom::Plain) add_large(table, room.room, 4096, plans, setting);
    report.add(std::move(table));
  }
  report.verdict(good ? Verdict::Agrees : Verdict::Partly, text + ".");
}

}  // namespace bdpt_experiments
