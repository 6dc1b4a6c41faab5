// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "bake_atlas.h"
#include "bake_target.h"
#include "exr_parts.h"
#include "output_path.h"

namespace bdpt_tool {
namespace {

constexpr std::uint32_t kDefaultResolution = 256, kProbeResolution = 64, kMaxRows = 65536;

// --what lightmap.
class LightmapTarget : public BakeTarget {
 public:
  explicit LightmapTarget(const BakeOptions& options) : options_(options), outputs_(bake_outputs(options, "e")) {
    require_extension("--output", options.render.output, ".exr");
    for (const auto& [given, option] : {std::pair(!options.grid.empty(), "--grid"),
                                        {!options.box.empty(), "--box"},
                                        {!options.points.empty(), "--points"}})
      if (given) throw Error(ExitCode::kUsage, std::string(option) + " needs --what probes, or --what points");
  }

  void read(const SceneDescription& description) override {
    atlases_ = atlases_of(description, options_.uv_set, options_.subset);
  }

  Sensor make_sensor(bdpt_context*, bdpt_scene* scene, const SceneDescription& description) override {
    instances_ = lightmap_instances(description, atlases_, options_.uv_set);
    const std::uint32_t given = options_.resolution ? options_.resolution : kDefaultResolution;
    resolution_ = options_.texels_per_unit > 0 ? resolution_for_density(scene) : given;
    if (std::uint64_t{resolution_} * atlases_.size() > kMaxRows)
      throw Error(ExitCode::kUsage, "--resolution: " + std::to_string(atlases_.size()) + " lightmaps of " +
                                        std::to_string(resolution_) +
                                        " rows are more than 65536; bake them in parts, with --subset");
    Sensor sensor = lightmap(scene, resolution_, instances_, atlases_.size());
    coverage_.resize(std::size_t{resolution_} * resolution_ * atlases_.size());
    check(bdpt_lightmap_read_texels(sensor.get(), coverage_.data(), nullptr, coverage_.size()), "the lightmap");
    return sensor;
  }

  void write(const bdpt_film* film, bool partial) override {
    const std::string& path = options_.render.output;
    const auto images = [&](std::size_t atlas) {
      std::vector<Image> planes = images_of(film, partial, atlas);
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

 private:
  // A lightmap of all atlases, or of one alone.
  Sensor lightmap(bdpt_scene* scene, std::uint32_t resolution, std::vector<bdpt_lightmap_instance> instances,
                  std::size_t atlases) {
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
    return make<Sensor>("the lightmap", bdpt_lightmap_create, scene, &desc);
  }

  // Texels to a side that give each atlas the density asked for at least.
  std::uint32_t resolution_for_density(bdpt_scene* scene) {
    double side = 1;
    for (std::size_t atlas = 0; atlas < atlases_.size(); ++atlas) {
      std::vector<bdpt_lightmap_instance> own;
      for (bdpt_lightmap_instance instance : instances_) {
        if (instance.atlas != atlas) continue;
        instance.atlas = 0;
        own.push_back(instance);
      }
      const Sensor probe = lightmap(scene, kProbeResolution, own, 1);
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

  // A plane of one atlas, its gutters filled.
  Image plane_of(const bdpt_film* film, bool partial, std::size_t atlas, std::uint32_t plane,
                 const std::vector<float>& coverage) {
    Image image(resolution_, resolution_);
    auto desc = sized<bdpt_read_desc>();
    desc.plane = plane;
    desc.rect[1] = static_cast<std::uint32_t>(atlas) * resolution_;
    desc.rect[2] = resolution_;
    desc.rect[3] = desc.rect[1] + resolution_;
    desc.include_partial = partial;
    check(bdpt_film_read(film, &desc, image.pixels.data(), image.pixels.size() * sizeof(float)), "the film");
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
  std::vector<Image> images_of(const bdpt_film* film, bool partial, std::size_t atlas) {
    const std::size_t texels = std::size_t{resolution_} * resolution_;
    const auto begin = coverage_.begin() + static_cast<std::ptrdiff_t>(atlas * texels);
    const std::vector<float> coverage(begin, begin + static_cast<std::ptrdiff_t>(texels));
    std::vector<Image> images;
    const std::size_t planes = layer_names().size() - 1;
    while (images.size() < planes)
      images.push_back(plane_of(film, partial, atlas, static_cast<std::uint32_t>(images.size()), coverage));
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

  // The file of an atlas: one of several has the node's name in its own.
  std::string path_of(const std::string& path, std::size_t atlas) const {
    if (atlases_.size() == 1) return path;
    const std::filesystem::path p(path);
    const std::string name = p.stem().string() + "-" + atlases_[atlas].file_name + p.extension().string();
    return (p.parent_path() / name).string();
  }

  const BakeOptions& options_;
  std::vector<BakeOutput> outputs_;
  std::vector<Atlas> atlases_;
  std::vector<bdpt_lightmap_instance> instances_;
  std::uint32_t resolution_ = 0;
  std::vector<float> coverage_;  // of all atlases
};

}  // namespace

std::unique_ptr<BakeTarget> lightmap_target(const BakeOptions& options) {
  return std::make_unique<LightmapTarget>(options);
}

}  // namespace bdpt_tool
