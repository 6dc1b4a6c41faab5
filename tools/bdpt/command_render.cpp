// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "advance.h"
#include "commands.h"
#include "film_output.h"
#include "interrupt.h"
#include "output_path.h"
#include "pyramid.h"
#include "render_options.h"
#include "render_outputs.h"
#include "render_report.h"
#include "scene_upload.h"
#include "stopwatch.h"
#include "view_options.h"

namespace bdpt_tool {
namespace {

constexpr std::uint32_t kMaxPyramidEdges = 15;     // what a film can hold
constexpr std::uint32_t kDefaultPyramidEdges = 7;  // where paths are not limited

class RenderCommand {
 public:
  explicit RenderCommand(const RenderOptions& options)
      : options_(options), techniques_(technique_mask(options)), outputs_(options.outputs, options.denoise) {}

  ExitCode run() {
    check_outputs();
    load();
    build();
    open_film();
    if (!interrupt_.interrupted()) render();
    write_outputs();
    report();
    return interrupt_.interrupted() ? ExitCode::kInterrupted : ExitCode::kSuccess;
  }

 private:
  void check_outputs() {
    check_color_options(options_.color, options_.view);
    exposure_of(options_.view);  // refused before anything is done
    require_extension("--output", options_.output, ".exr");
    require_extension("--png", options_.png, ".png");
    require_writable_file("--output", options_.output);
    require_writable_file("--png", options_.png);
    require_writable_file("--film", options_.film);
    require_writable_folder("--pyramid", options_.pyramid);
    if (options_.resume && options_.film.empty()) throw Error(ExitCode::kUsage, "--resume needs --film");
  }

  void load() {
    const Stopwatch watch;
    description_ = read_scene(options_.scene, diagnostics_, options_.read);
    range_ = pass_range(options_, description_.samples_per_pixel);
    max_edges_ = options_.max_edges.value_or(description_.max_edges);
    report_.load_seconds = watch.seconds();
  }

  void build() {
    const Stopwatch watch;
    const auto [width, height] = picture_size(options_, description_.film);
    bdpt_camera_desc camera = camera_desc(description_, width, height, diagnostics_, options_.camera);
    has_lens_ = camera.lens_radius > 0 || camera.type == BDPT_CAMERA_LENS;
    is_cube_ = camera.type == BDPT_CAMERA_CUBE;
    outputs_.add_to(camera);
    context_ = make_context(options_.threads, diagnostics_, options_.color);
    options_.view.context = context_.get();
    check_view(options_.view);
    sensor_ = make<Sensor>(camera_where(), bdpt_camera_create, context_.get(), &camera);
    scene_ = build_scene(context_.get(), description_, interrupt_.token());
    if (!scene_) throw Error(ExitCode::kInterrupted, "interrupted while the scene was built; nothing is written");
    check(bdpt_scene_get_info(scene_.get(), &report_.scene), "the scene");
    report_.build_seconds = watch.seconds();
  }

  std::string camera_where() const { return description_.camera.where.prefix() + "the camera"; }

  // The film's filter: the file's, unless the command line names another.
  bdpt_film_desc film_desc() {
    const FilmDescription& film = description_.film;
    auto desc = sized<bdpt_film_desc>();
    desc.filter = options_.filter.value_or(film.filter);
    if (!options_.filter && is_cube_) {
      desc.filter = BDPT_FILTER_BOX;
    } else if (!options_.filter) {
      desc.filter_radius = film.filter_radius;
      desc.filter_a = film.filter_a;
      desc.filter_b = film.filter_b;
    }
    if (options_.filter_radius > 0) desc.filter_radius = options_.filter_radius;
    desc.normalization = options_.normalization;
    desc.pyramid_edges = pyramid_edges();
    return desc;
  }

  std::uint32_t pyramid_edges() {
    if (options_.pyramid.empty()) return 0;
    if (max_edges_ == 0) {
      std::fprintf(stderr, "bdpt: paths are not limited; the pyramid shows those of up to %u edges\n",
                   kDefaultPyramidEdges);
      return kDefaultPyramidEdges;
    }
    if (max_edges_ > kMaxPyramidEdges) {
      std::fprintf(stderr, "bdpt: the pyramid shows paths of up to %u of %u edges\n", kMaxPyramidEdges, max_edges_);
    }
    return std::min(max_edges_, kMaxPyramidEdges);
  }

  void open_film() {
    if (options_.resume && std::filesystem::exists(options_.film)) {
      film_ = load_film(context_.get(), options_.film);
      const bdpt_film_info info = film_info(film_.get());
      if (info.passes > 0) range_.first = std::max(range_.first, info.next_pass);
      if (!options_.pyramid.empty() && info.pyramid_edges == 0) {
        throw Error(ExitCode::kMismatch, options_.film + ": this film has no pyramid; render it anew with --pyramid");
      }
    } else {
      const bdpt_film_desc desc = film_desc();
      film_ = make<Film>("the film", bdpt_film_create, sensor_.get(), &desc);
    }
  }

  void render() {
    const Stopwatch watch;
    const bdpt_render_desc desc = render_desc(options_, techniques_, range_.first, max_edges_);
    const Render render =
        make<Render>("the render", bdpt_render_create, scene_.get(), sensor_.get(), film_.get(), &desc);
    advance(render.get(), film_.get(), options_, range_, interrupt_.token());
    report_.render_seconds = watch.seconds();
    check(bdpt_render_get_stats(render.get(), &report_.stats), "the render");
    report_.techniques = read_techniques(render.get());
  }

  void write_outputs() {
    const bool partial = interrupt_.interrupted();
    const Image denoised = outputs_.denoised(film_.get(), partial, options_.threads);
    if (outputs_.any()) {
      outputs_.write(options_.output, film_.get(), partial, context_.get(), description_, denoised);
    } else {
      write_film_exr(options_.output, film_.get(), partial, context_.get());
    }
    if (!options_.png.empty()) {
      const bool noisy = denoised.pixels.empty();
      write_png(options_.png, noisy ? read_layer(film_.get(), BDPT_LAYER_COLOR, partial) : denoised, options_.view);
    }
    if (!options_.pyramid.empty()) {
      write_pyramid(options_.pyramid, film_.get(), techniques_, has_lens_, partial, options_.view);
    }
    save_film(film_.get(), options_);
  }

  void report() {
    report_.film = film_info(film_.get());
    check(bdpt_context_get_info(context_.get(), &report_.context), "the context");
    report_.warnings = diagnostics_.count();
    report_.interrupted = interrupt_.interrupted();
    if (options_.json) print_json(report_);
    if (isatty(STDERR_FILENO)) print_summary(report_);
  }

  RenderOptions options_;
  TechniqueMask techniques_;
  RenderOutputs outputs_;
  PassRange range_;
  std::uint32_t max_edges_ = 0;
  bool has_lens_ = false, is_cube_ = false;
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

void add_render_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("render", "Render a scene");
  const auto options = std::make_shared<RenderOptions>();
  add_render_options(*command, *options);
  command->callback([&chosen, options] { chosen = [options] { return RenderCommand(*options).run(); }; });
}

}  // namespace bdpt_tool
