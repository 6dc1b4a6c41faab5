// What an experiment has to tell: a verdict, tables, plots and pictures. It ends as one JSON file, from which page.py
// makes the page.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "contest.h"
#include "estimate.h"
#include "image.h"
#include "setting.h"

namespace bdpt_experiments {

struct Experiment;

enum class Verdict { Open, Agrees, Partly, Differs, Skipped, Told };  // told: there is no claim to agree with

using Cell = std::variant<std::string, double, Estimate>;

struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;
};

struct Series {
  std::string name;
  std::vector<double> x;
  std::vector<Estimate> y;
};

// Both axes are logarithmic.
struct Plot {
  std::string title, x, y;
  std::vector<Series> series;
};

class Report {
 public:
  Report(const Experiment& experiment, const Setting& setting) : experiment_(experiment), setting_(setting) {}

  const Setting& setting() const { return setting_; }

  // One sentence on how it was measured here, and where that is not what the paper did.
  void measured(const std::string& text) { measured_ = text; }
  // The last one counts.
  void verdict(Verdict verdict, const std::string& text) { verdict_ = {verdict, text}; }
  void note(const std::string& text) { notes_.push_back(text); }
  // Notes the variants that the library lacks.
  void note_missing(const std::vector<Variant>& variants);
  void add(Table table) { tables_.push_back(std::move(table)); }
  void add(Plot plot) { plots_.push_back(std::move(plot)); }

  // Two pictures of the same size, one over the other, with a slider between them.
  void compare(const std::string& title, const std::string& left_label, const bdpt_tool::Image& left,
               const std::string& right_label, const bdpt_tool::Image& right, float exposure);
  void picture(const std::string& title, const bdpt_tool::Image& image, float exposure);
  // The film's techniques on one sheet; each row of k edges over-exposed by k - 1 stops where `expose_rows`.
  void pyramid(const std::string& title, const bdpt_film* film, bool with_t0, bool expose_rows, float exposure);

  // Writes <id>.json into the output folder.
  void write(double seconds, double processor_share) const;

 private:
  struct Picture {
    std::string kind, title, file, label, other_file, other_label;
  };
  std::string write_image(const bdpt_tool::Image& image, float exposure);

  const Experiment& experiment_;
  const Setting& setting_;
  std::string measured_;
  std::pair<Verdict, std::string> verdict_ = {Verdict::Open, "not measured"};
  std::vector<std::string> notes_;
  std::vector<Table> tables_;
  std::vector<Plot> plots_;
  std::vector<Picture> pictures_;
  int images_ = 0;
};

}  // namespace bdpt_experiments
