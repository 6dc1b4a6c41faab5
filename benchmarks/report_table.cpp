// SPDX-License-Identifier: Apache-2.0
#include "report_table.h"

#include <cstdio>
#include <optional>
#include <vector>

#include "targets.h"

namespace bdpt_benchmark {
namespace {

using Row = std::vector<std::string>;

const Row kHead = {"scene",
                   "integrator",
                   "samples/s, thousands",
                   "eye, light, shadow rays/s, millions",
                   "start",
                   "extend",
                   "its rays",
                   "connect",
                   "shadow",
                   "accumulate",
                   "rest",
                   "replay ratio",
                   "cost of a sample, in path samples",
                   "mean over bdpt's",
                   "relative variance",
                   "efficiency, 1/s",
                   "threads / one",
                   "the same, Embree",
                   "context peak, MiB",
                   "VmHWM, MiB",
                   "memory used, MiB",
                   "allowed, MiB",
                   "used / allowed"};

std::string number(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

// To that many significant digits, never as a power of ten.
std::string significant(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%#.*g", digits, value);
  std::string s = text;
  if (s.find('e') != std::string::npos) return number(value, value < 1 ? 6 : 0);
  if (s.back() == '.') s.pop_back();
  return s;
}

std::string percent(double share) { return number(100 * share, 0) + " %"; }
std::string mebibytes(double bytes) { return number(bytes / (1024 * 1024), 1); }

// A figure, and beside it the target where there is one.
std::string judged(const std::string& figure, const std::optional<Verdict>& verdict) {
  if (!verdict) return figure;
  char limit[32];
  std::snprintf(limit, sizeof limit, "%g", verdict->limit);
  const std::string target = std::string(verdict->at_most ? "≤ " : "≥ ") + limit;
  return figure + (verdict->met() ? " (" + target + ": met)" : " (**" + target + ": missed**)");
}

std::string efficiency(const SceneResult& scene, const IntegratorResult& result) {
  const std::string figure = significant(result.efficiency, 3);
  const auto verdict = judge_efficiency(scene, result);
  return verdict ? figure + "; " + judged(significant(verdict->value, 3) + " x pbrt-v4", verdict) : figure;
}

void append_memory(Row& row, const SceneResult& scene) {
  const MemoryResult& m = scene.memory;
  row.insert(row.end(), {mebibytes(double(m.context_peak)), mebibytes(double(m.process_peak)), mebibytes(m.used),
                         mebibytes(m.allowed), judged(number(m.used / m.allowed, 2), judge_memory(scene))});
}

std::string millions(double rays) { return number(rays / 1e6, 2); }

Row make_row(const Results& results, const SceneResult& scene, const IntegratorResult& r) {
  const IntegratorResult& last = scene.integrators.back();
  const StageShares& s = r.stages;
  Row row = {scene.name, r.name, significant(r.samples_per_second / 1e3, 3),
             millions(r.eye_rays_per_second) + ", " + millions(r.light_rays_per_second) + ", " +
                 millions(r.shadow_rays_per_second)};
  for (double share : {s.start, s.extend, s.rays, s.connect, s.shadow, s.accumulate, s.rest})
    row.push_back(percent(share));
  row.push_back(judged(number(r.replay_ratio, 2), judge_replay(scene, r)));
  row.push_back(judged(number(r.cost, 2), judge_cost(scene, r)));
  row.push_back(number(r.image_mean / last.image_mean, 3));
  row.push_back(significant(r.relative_variance, 3));
  row.push_back(efficiency(scene, r));
  row.push_back(judged(number(r.scaling, 2), judge_scaling(results, r)));
  row.push_back(number(r.replay_scaling, 2));
  if (&r == &last)  // memory is measured with this one
    append_memory(row, scene);
  else
    row.resize(kHead.size());
  return row;
}

std::string line(const Row& row) {
  std::string text = "|";
  for (const std::string& cell : row) text += " " + cell + " |";
  return text + "\n";
}

}  // namespace

std::string table(const Results& results) {
  std::string text = line(kHead) + line(Row(kHead.size(), "---"));
  for (const SceneResult& scene : results.scenes)
    for (const IntegratorResult& integrator : scene.integrators) text += line(make_row(results, scene, integrator));
  return text;
}

}  // namespace bdpt_benchmark
