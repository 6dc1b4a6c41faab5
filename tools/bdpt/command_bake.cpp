// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "advance.h"
#include "bake_atlas.h"
#include "bake_options.h"
#include "commands.h"
#include "exr_parts.h"
#include "film_output.h"
#include "interrupt.h"
#include "output_path.h"
#include "scene_upload.h"

namespace bdpt_tool {
namespace {

constexpr std::uint32_t kDefaultResolution = 256, kProbeResolution = 64, kMaxRows = 65536;

class BakeCommand {
 public:
  explicit BakeCommand(const BakeOptions& options)
      : options_(options), outputs_(bake_outputs(options)), techniques_(bake_techniques(options)) {}

  ExitCode run() {
    check_files();
    load();
    make_sensor();
    open_film();
    if (!interrupt_.interrupted()) bake();
    write();
    save_film(film_.get(), options_.render);
    return interrupt_.interrupted() ? ExitCode::kInterrupted : ExitCode::kSuccess;
  }

 private:
  void check_files() const {
    require_extension("--output", options_.render.output, ".exr");
    require_extension("--png", options_.render.png, ".png");
    require_writable_file("--output", options_.render.output);
    require_writable_file("--png", options_.render.png);
    require_writable_file("--film", options_.render.film);
    if (options_.render.resume && options_.render.film.empty()) throw Error(ExitCode::kUsage, "--resume needs --film");
  }

  void load() {
    SceneDescription description = read_scene(options_.render.scene, diagnostics_);
    range_ = pass_range(options_.render, description.samples_per_pixel);
    max_edges_ = options_.render.max_edges.value_or(description.max_edges);
    atlases_ = atlases_of(description, options_.uv_set, options_.subset);
    context_ = make_context(options_.render.threads, diagnostics_);
    scene_ = build_scene(context_.get(), description, interrupt_.token());
    if (!scene_) throw Error(ExitCode::kInterrupted, "interrupted while the scene was built; nothing is written");
    instances_ = lightmap_instances(description, atlases_, options_.uv_set);
  }

  // A lightmap of all atlases, or of one alone.
  Sensor lightmap(std::uint32_t resolution, std::vector<bdpt_lightmap_instance> instances, std::size_t atlases) {
    std::vector<bdpt_output_desc> outputs;
    for (const BakeOutput& output : outputs_) outputs.push_back(output.desc);
    auto desc = sized<bdpt_lightmap_desc>();
    desc.width = desc.height = resolution;
    desc.atlas_count = static_cast<std::uint32_t>(atlases);
    desc.instances = instances.data();
    desc.instance_count = static_cast<std::uint32_t>(instances.size());
    desc.outputs = outputs.data();
    desc.output_count = static_cast<std::uint32_t>(outputs.size());
    desc.geometric_normals = options_.geometric_normals;
    return make<Sensor>("the lightmap", bdpt_lightmap_create, scene_.get(), &desc);
  }

  // Texels to a side that give each atlas the density asked for at least.
  std::uint32_t resolution_for_density() {
    double side = 1;
    for (std::size_t atlas = 0; atlas < atlases_.size(); ++atlas) {
      std::vector<bdpt_lightmap_instance> own;
      for (bdpt_lightmap_instance instance : instances_) {
        if (instance.atlas != atlas) continue;
        instance.atlas = 0;
        own.push_back(instance);
      }
      const Sensor probe = lightmap(kProbeResolution, own, 1);
      auto info = sized<bdpt_lightmap_info>();
      check(bdpt_lightmap_get_info(probe.get(), &info), "the lightmap");
      std::vector<float> coverage(kProbeResolution * kProbeResolution);
      check(bdpt_lightmap_read_texels(probe.get(), coverage.data(), nullptr, coverage.size()), "the lightmap");
      double covered = 0;
      for (const float c : coverage) covered += static_cast<double>(c) / static_cast<double>(coverage.size());
      side = std::max(side, options_.texels_per_unit * std::sqrt(info.area / covered));
    }
    if (side > kMaxRows) throw Error(ExitCode::kUsage, "--texels-per-unit: a lightmap would have more than 65536 rows");
    return static_cast<std::uint32_t>(std::ceil(side));
  }

  void make_sensor() {
    const std::uint32_t given = options_.resolution ? options_.resolution : kDefaultResolution;
    resolution_ = options_.texels_per_unit > 0 ? resolution_for_density() : given;
    if (std::uint64_t{resolution_} * atlases_.size() > kMaxRows)
      throw Error(ExitCode::kUsage, "--resolution: " + std::to_string(atlases_.size()) + " lightmaps of " +
                                        std::to_string(resolution_) +
                                        " rows are more than 65536; bake them in parts, with --subset");
    sensor_ = lightmap(resolution_, instances_, atlases_.size());
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
    const bdpt_render_desc desc = render_desc(options_.render, techniques_, range_.first, max_edges_);
    const Render render = make<Render>("the bake", bdpt_render_create, scene_.get(), sensor_.get(), film_.get(), &desc);
    advance(render.get(), film_.get(), options_.render, range_, interrupt_.token());
  }

  // A plane of one atlas, its gutters filled.
  Image plane_of(std::size_t atlas, std::uint32_t plane, const std::vector<float>& coverage) {
    Image image(resolution_, resolution_);
    auto desc = sized<bdpt_read_desc>();
    desc.plane = plane;
    desc.rect[1] = static_cast<std::uint32_t>(atlas) * resolution_;
    desc.rect[2] = resolution_;
    desc.rect[3] = desc.rect[1] + resolution_;
    desc.include_partial = interrupt_.interrupted();
    check(bdpt_film_read(film_.get(), &desc, image.pixels.data(), image.pixels.size() * sizeof(float)), "the film");
    if (options_.gutter == 0) return image;
    std::vector<std::uint8_t> mask;
    for (const float c : coverage) mask.push_back(c > 0);
    auto dilate = sized<bdpt_lightmap_dilate_desc>();
    dilate.width = dilate.height = resolution_;
    dilate.channels = 3;
    dilate.steps = options_.gutter;
    dilate.pixels = image.pixels.data(), dilate.pixels_capacity = image.pixels.size() * sizeof(float);
    dilate.mask = mask.data(), dilate.mask_capacity = mask.size();
    check(bdpt_lightmap_dilate(&dilate, nullptr), "the gutters");
    return image;
  }

  // The planes of an atlas, and its coverage.
  std::vector<Image> images_of(std::size_t atlas) {
    const std::size_t texels = std::size_t{resolution_} * resolution_;
    std::vector<float> all(texels * atlases_.size());
    check(bdpt_lightmap_read_texels(sensor_.get(), all.data(), nullptr, all.size()), "the lightmap");
    const std::vector<float> coverage(all.begin() + static_cast<std::ptrdiff_t>(atlas * texels),
                                      all.begin() + static_cast<std::ptrdiff_t>((atlas + 1) * texels));
    std::vector<Image> images;
    const std::size_t planes = layer_names().size() - 1;
    while (images.size() < planes)
      images.push_back(plane_of(atlas, static_cast<std::uint32_t>(images.size()), coverage));
    images.emplace_back(resolution_, resolution_);
    for (std::size_t i = 0; i < 3 * texels; ++i) images.back().pixels[i] = coverage[i / 3];
    return images;
  }

  std::vector<std::string> layer_names() const {
    std::vector<std::string> names;
    for (const BakeOutput& output : outputs_) names.insert(names.end(), output.layers.begin(), output.layers.end());
    names.push_back("coverage");
    return names;
  }

  void write() {
    const std::string& path = options_.render.output;
    const auto images = [this](std::size_t atlas) {
      std::vector<Image> planes = images_of(atlas);
      const std::string& png = options_.render.png;
      if (!png.empty()) write_png(path_of(png, atlas), planes[0], options_.render.view);
      return planes;
    };
    if (!options_.files && atlases_.size() > 1) {
      std::vector<std::string> parts;
      for (const Atlas& atlas : atlases_) parts.push_back(atlas.name);
      return write_exr_parts(path, parts, layer_names(), images);
    }
    for (std::size_t atlas = 0; atlas < atlases_.size(); ++atlas)
      write_layers(path_of(path, atlas), images(atlas), layer_names());
  }

  // The file of an atlas: one of several has the node's name in its own.
  std::string path_of(const std::string& path, std::size_t atlas) const {
    if (atlases_.size() == 1) return path;
    const std::filesystem::path p(path);
    const std::string name = p.stem().string() + "-" + atlases_[atlas].file_name + p.extension().string();
    return (p.parent_path() / name).string();
  }

  BakeOptions options_;
  std::vector<BakeOutput> outputs_;
  TechniqueMask techniques_;
  PassRange range_;
  std::uint32_t max_edges_ = 0, resolution_ = 0;
  Diagnostics diagnostics_;
  InterruptGuard interrupt_;
  std::vector<Atlas> atlases_;
  std::vector<bdpt_lightmap_instance> instances_;
  Context context_;
  Scene scene_;
  Sensor sensor_;
  Film film_;
};

}  // namespace

void add_bake_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("bake", "Bake the light that arrives at surfaces into lightmaps");
  const auto options = std::make_shared<BakeOptions>();
  add_bake_options(*command, *options);
  command->callback([&chosen, options] { chosen = [options] { return BakeCommand(*options).run(); }; });
}

}  // namespace bdpt_tool
