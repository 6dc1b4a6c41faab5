// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "advance.h"
#include "bake_target.h"
#include "commands.h"
#include "film_output.h"
#include "interrupt.h"
#include "output_path.h"
#include "render_report.h"
#include "scene_upload.h"
#include "stopwatch.h"

namespace bdpt_tool {
namespace {

class BakeCommand {
 public:
  explicit BakeCommand(const BakeOptions& options)
      : options_(options),
        techniques_(bake_techniques(options)),
        target_(options.what == "lightmap" ? lightmap_target(options_) : points_target(options_)) {}

  ExitCode run() {
    check_files();
    load();
    build();
    open_film();
    if (!interrupt_.interrupted()) bake();
    target_->write(film_.get(), interrupt_.interrupted());
    save_film(film_.get(), options_.render);
    report();
    return interrupt_.interrupted() ? ExitCode::kInterrupted : ExitCode::kSuccess;
  }

 private:
  void check_files() const {
    exposure_of(options_.render.view);  // refused before anything is done
    require_extension("--png", options_.render.png, ".png");
    require_writable_file("--output", options_.render.output);
    require_writable_file("--png", options_.render.png);
    require_writable_file("--film", options_.render.film);
    if (options_.render.resume && options_.render.film.empty()) throw Error(ExitCode::kUsage, "--resume needs --film");
  }

  void load() {
    const Stopwatch watch;
    description_ = read_scene(options_.render.scene, diagnostics_, options_.render.read);
    range_ = pass_range(options_.render, description_.samples_per_pixel);
    max_edges_ = options_.render.max_edges.value_or(description_.max_edges);
    target_->read(description_);
    report_.load_seconds = watch.seconds();
  }

  void build() {
    const Stopwatch watch;
    context_ = make_context(options_.render.threads, diagnostics_);
    scene_ = build_scene(context_.get(), description_, interrupt_.token());
    if (!scene_) throw Error(ExitCode::kInterrupted, "interrupted while the scene was built; nothing is written");
    sensor_ = target_->make_sensor(context_.get(), scene_.get(), description_);
    check(bdpt_scene_get_info(scene_.get(), &report_.scene), "the scene");
    report_.build_seconds = watch.seconds();
  }

  void open_film() {
    if (options_.render.resume && std::filesystem::exists(options_.render.film)) {
      film_ = load_film(context_.get(), options_.render.film);
      const bdpt_film_info info = film_info(film_.get());
      if (info.passes > 0) range_.first = std::max(range_.first, info.next_pass);
    } else {
      film_ = make<Film>("the film", bdpt_film_create, sensor_.get(), nullptr);
    }
  }

  void bake() {
    const Stopwatch watch;
    const bdpt_render_desc desc = render_desc(options_.render, techniques_, range_.first, max_edges_);
    const Render render = make<Render>("the bake", bdpt_render_create, scene_.get(), sensor_.get(), film_.get(), &desc);
    advance(render.get(), film_.get(), options_.render, range_, interrupt_.token());
    report_.render_seconds = watch.seconds();
    check(bdpt_render_get_stats(render.get(), &report_.stats), "the bake");
    report_.techniques = read_techniques(render.get());
  }

  void report() {
    report_.film = film_info(film_.get());
    check(bdpt_context_get_info(context_.get(), &report_.context), "the context");
    report_.warnings = diagnostics_.count();
    report_.interrupted = interrupt_.interrupted();
    if (options_.render.json) print_json(report_);
    if (isatty(STDERR_FILENO)) print_summary(report_);
  }

  BakeOptions options_;
  TechniqueMask techniques_;
  std::unique_ptr<BakeTarget> target_;
  PassRange range_;
  std::uint32_t max_edges_ = 0;
  Diagnostics diagnostics_;
  InterruptGuard interrupt_;
  SceneDescription description_;
  RenderReport report_;
  Context context_;
  Scene scene_;
  Sensor sensor_;
  Film film_;
};

}  // namespace

void add_bake_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("bake", "Bake the light that arrives at surfaces, and at points in space");
  const auto options = std::make_shared<BakeOptions>();
  add_bake_options(*command, *options);
  command->callback([&chosen, options] { chosen = [options] { return BakeCommand(*options).run(); }; });
}

}  // namespace bdpt_tool
