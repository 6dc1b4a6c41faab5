// Runs the papers' experiments and writes what they show, for page.py; see docs/experiments.md.
//
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "error.h"
#include "experiment.h"
#include "job.h"
#include "timing.h"

namespace {

using namespace bdpt_experiments;
using bdpt_benchmark::processor_seconds;

std::string all_ids() {
  std::string ids;
  for (const Experiment& e : experiments()) ids += std::string(ids.empty() ? "" : ", ") + e.id;
  return ids;
}

std::vector<const Experiment*> chosen(const std::vector<std::string>& ids) {
  std::vector<const Experiment*> result;
  for (const Experiment& e : experiments())
    if (ids.empty() || std::find(ids.begin(), ids.end(), e.id) != ids.end()) result.push_back(&e);
  for (const std::string& id : ids)
    if (std::none_of(experiments().begin(), experiments().end(), [&](const Experiment& e) { return id == e.id; }))
      throw bdpt_tool::Error(bdpt_tool::ExitCode::kUsage,
                             "there is no experiment '" + id + "'; there are: " + all_ids());
  return result;
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Whether it went well; a row that fails is told on the page, and does not keep the others from running.
bool run(const Experiment& experiment, const Setting& setting) {
  std::fprintf(stderr, "%-12s %s ... ", experiment.id, experiment.title);
  std::fflush(stderr);
  const double begin = wall_seconds(), processor = processor_seconds();
  Report report(experiment, setting);
  bool failed = false;
  try {
    experiment.run(report);
  } catch (const SceneMissing& missing) {
    report.verdict(Verdict::Skipped, std::string("Skipped: ") + missing.what() + ".");
  } catch (const std::exception& error) {
    report.verdict(Verdict::Open, std::string("Not measured: ") + error.what());
    failed = true;
    std::fprintf(stderr, "failed: %s; ", error.what());
  }
  const double seconds = wall_seconds() - begin;
  const unsigned threads = setting.threads ? setting.threads : std::max(1u, std::thread::hardware_concurrency());
  report.write(seconds, (processor_seconds() - processor) / (seconds * threads));
  std::fprintf(stderr, "%.0f s\n", seconds);
  return !failed;
}

}  // namespace

int main(int argc, char** argv) {
  Setting setting;
  setting.scenes = BDPT_EXPERIMENT_SCENES;
  setting.output = "experiments";
  std::vector<std::string> ids;
  bool list = false, quick = false, tiny = false;
  CLI::App app("Runs the papers' experiments; all of them, or those named.");
  app.add_option("id", ids, "experiments, by their ids: see --list");
  app.add_flag("--list", list, "print each id with its paper and title, and stop");
  app.add_flag("--quick", quick, "smaller pictures, fewer turns: a quarter of an hour on two cores");
  app.add_flag("--tiny", tiny, "so small that it measures nothing, for the tests")->group("");
  app.add_option("--scenes", setting.scenes, "folder of scenes; what is not there is skipped")->capture_default_str();
  app.add_option("-o,--output", setting.output, "folder for the results")->capture_default_str();
  app.add_option("--threads", setting.threads, "threads that render (default: one per core)")
      ->check(CLI::Range(1, 1024));
  CLI11_PARSE(app, argc, argv);
  setting.size = tiny ? Size::Tiny : quick ? Size::Quick : Size::Full;
  try {
    if (list) {
      for (const Experiment& e : experiments()) std::printf("%-12s %-28s %s\n", e.id, e.paper, e.title);
      return 0;
    }
    const auto experiments = chosen(ids);
    std::filesystem::create_directories(setting.output);
    bool good = true;
    for (const Experiment* experiment : experiments) good = run(*experiment, setting) && good;
    return good ? 0 : static_cast<int>(bdpt_tool::ExitCode::kFailure);
  } catch (const bdpt_tool::Error& error) {
    std::fprintf(stderr, "bdpt_experiments: %s\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bdpt_experiments: %s\n", error.what());
    return 1;
  }
}
