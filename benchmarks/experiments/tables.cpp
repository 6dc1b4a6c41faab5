// SPDX-License-Identifier: Apache-2.0
#include "tables.h"

#include <cmath>

namespace bdpt_experiments {

Table contest_table(const std::string& title, const std::vector<Contestant>& contestants) {
  const Contestant& last = contestants.back();
  Table table{title,
              {"", "samples a pixel", "seconds", "mean / " + contestants.front().variant.name, "relative variance",
               "efficiency / " + last.variant.name},
              {}};
  for (const Contestant& c : contestants)
    table.rows.push_back({c.variant.name, double(c.end().passes), seconds(c.end()),
                          mean_ratio(c.end(), contestants.front().end()), relative_variance(c.end()),
                          &c == &last ? Cell("1") : Cell(efficiency_ratio(c.end(), last.end()))});
  return table;
}

Plot convergence(const std::string& title, const std::vector<Contestant>& contestants) {
  Plot plot{title, "seconds", "relative variance", {}};
  for (const Contestant& c : contestants) {
    Series series{c.variant.name, {}, {}};
    for (const Checkpoint& checkpoint : c.checkpoints) {
      series.x.push_back(seconds(checkpoint));
      series.y.push_back(relative_variance(checkpoint));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

const Contestant* find(const std::vector<Contestant>& contestants, const std::string& name) {
  for (const Contestant& c : contestants)
    if (c.variant.name == name) return &c;
  return nullptr;
}

std::string label(const Contestant& c) {
  return c.variant.name + ", " + std::to_string(c.end().passes) + " samples a pixel";
}

// Ratios err by factors.
bool above(const Estimate& ratio, double limit) {
  return ratio.value * std::exp(-2 * ratio.error / ratio.value) > limit;
}
bool below(const Estimate& ratio, double limit) {
  return ratio.value * std::exp(2 * ratio.error / ratio.value) < limit;
}

}  // namespace bdpt_experiments
