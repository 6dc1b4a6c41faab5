// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <fstream>

#include "experiment.h"
#include "film_output.h"
#include "json.h"
#include "pyramid.h"

namespace bdpt_experiments {
namespace {

using bdpt_tool::JsonWriter;

constexpr std::uint32_t kSheetWidth = 900;  // of pyramids, pixels

const char* name(Verdict verdict) {
  const char* const names[] = {"open", "agrees", "partly", "differs", "skipped", "told"};
  return names[static_cast<int>(verdict)];
}

const char* name(Size size) {
  const char* const names[] = {"full", "quick", "tiny"};
  return names[static_cast<int>(size)];
}

void write_strings(JsonWriter& out, const char* key, const std::vector<std::string>& values) {
  out.open_list(key);
  for (const std::string& value : values) out.element(value);
  out.close_list();
}

void write_estimate(JsonWriter& out, const Estimate& e) {
  out.open();
  out.value("value", e.value);
  out.value("error", e.error);
  out.value("text", text(e));
  out.close();
}

void write_cell(JsonWriter& out, const Cell& cell) {
  if (const auto* words = std::get_if<std::string>(&cell))
    out.element(*words);
  else if (const auto* number = std::get_if<double>(&cell))
    out.element(*number);
  else
    write_estimate(out, std::get<Estimate>(cell));
}

void write_table(JsonWriter& out, const Table& table) {
  out.open();
  out.value("title", table.title);
  write_strings(out, "columns", table.columns);
  out.open_list("rows");
  for (const auto& row : table.rows) {
    out.open_list();
    for (const Cell& cell : row) write_cell(out, cell);
    out.close_list();
  }
  out.close_list();
  out.close();
}

void write_plot(JsonWriter& out, const Plot& plot) {
  out.open();
  out.value("title", plot.title);
  out.value("x", plot.x);
  out.value("y", plot.y);
  out.open_list("series");
  for (const Series& series : plot.series) {
    out.open();
    out.value("name", series.name);
    out.array("x", series.x);
    out.open_list("y");
    for (const Estimate& y : series.y) write_estimate(out, y);
    out.close_list();
    out.close();
  }
  out.close_list();
  out.close();
}

}  // namespace

void Report::note_missing(const std::vector<Variant>& variants) {
  for (const Variant& variant : variants)
    if (const std::string what = lacks(variant); !what.empty())
      note("Not compared with " + variant.name + ": this build of the library lacks " + what + ".");
}

std::string Report::write_image(const bdpt_tool::Image& image, float exposure) {
  const std::string file = std::string(experiment_.id) + "-" + std::to_string(images_++) + ".png";
  bdpt_tool::ViewOptions view;
  view.exposure = exposure;
  bdpt_tool::write_png(setting_.output + "/" + file, image, view);
  return file;
}

void Report::compare(const std::string& title, const std::string& left_label, const bdpt_tool::Image& left,
                     const std::string& right_label, const bdpt_tool::Image& right, float exposure) {
  const std::string file = write_image(left, exposure), other = write_image(right, exposure);
  pictures_.push_back({"compare", title, file, left_label, other, right_label});
}

void Report::picture(const std::string& title, const bdpt_tool::Image& image, float exposure) {
  const std::string file = write_image(image, exposure);
  pictures_.push_back({"picture", title, file, "", "", ""});
}

void Report::pyramid(const std::string& title, const bdpt_film* film, bool with_t0, bool expose_rows, float exposure) {
  const auto sheet =
      bdpt_tool::pyramid_sheet(film, bdpt_tool::parse_technique_mask("all"), with_t0, false, expose_rows, kSheetWidth);
  const std::string file = write_image(sheet, exposure);
  pictures_.push_back({"pyramid", title, file, "", "", ""});
}

void Report::write(double seconds, double processor_share) const {
  JsonWriter out;
  out.value("id", experiment_.id);
  out.value("paper", experiment_.paper);
  out.value("title", experiment_.title);
  out.value("claim", experiment_.claim);
  out.value("size", name(setting_.size));
  out.value("seconds", seconds);
  out.value("processor_share", processor_share);
  out.value("verdict", name(verdict_.first));
  out.value("verdict_text", verdict_.second);
  out.value("measured", measured_);
  write_strings(out, "notes", notes_);
  out.open_list("tables");
  for (const Table& table : tables_) write_table(out, table);
  out.close_list();
  out.open_list("plots");
  for (const Plot& plot : plots_) write_plot(out, plot);
  out.close_list();
  out.open_list("pictures");
  for (const Picture& p : pictures_) {
    out.open();
    out.value("kind", p.kind);
    out.value("title", p.title);
    out.value("file", p.file);
    out.value("label", p.label);
    out.value("other_file", p.other_file);
    out.value("other_label", p.other_label);
    out.close();
  }
  out.close_list();
  const std::string path = setting_.output + "/" + experiment_.id + ".json";
  std::ofstream file(path);
  file << std::move(out).finish() << std::flush;
  if (!file) throw bdpt_tool::Error(bdpt_tool::ExitCode::kOutput, path + ": cannot write");
}

}  // namespace bdpt_experiments
