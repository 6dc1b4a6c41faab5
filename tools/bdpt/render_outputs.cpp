// SPDX-License-Identifier: Apache-2.0
#include "render_outputs.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <deque>
#include <set>
#include <sstream>

#include "cryptomatte.h"
#include "exr_channels.h"
#include "film_output.h"

namespace bdpt_tool {

const char kOutputsHelp[] =
    "Layers beside the picture, by commas: albedo, normal (N), depth (depth.Z, along the axis; 1e10 where nothing is), "
    "position (P), direct, indirect, group:N (group0 ...: the light of group N), cryptoobject, cryptomaterial "
    "(Cryptomatte, 6 ranks), samples";

namespace {

constexpr float kNoDepth = 1e10f;  // what compositors take for infinitely far
constexpr std::uint32_t kCoverageRanks = 8;

const std::vector<std::string> kColors = {"R", "G", "B"}, kVector = {"X", "Y", "Z"};

bool is_coverage(bdpt_output_kind kind) {
  return kind == BDPT_OUTPUT_INSTANCE_COVERAGE || kind == BDPT_OUTPUT_MATERIAL_COVERAGE;
}

Image read_plane(const bdpt_film* film, bdpt_layer layer, std::uint32_t plane, bool partial) {
  const bdpt_film_info info = film_info(film);
  Image image(info.width, info.height);
  auto desc = sized<bdpt_read_desc>();
  desc.layer = layer;
  desc.plane = plane;
  desc.include_partial = partial;
  check(bdpt_film_read(film, &desc, image.pixels.data(), image.pixels.size() * sizeof(float)), "reading the film");
  return image;
}

// From means over all samples to those over what is seen.
void finish_depth(Image& image) {
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    image.pixels[i] = image.pixels[i + 2] > 0 ? image.pixels[i] / image.pixels[i + 2] : kNoDepth;
}

std::vector<bdpt_coverage> read_coverage(const bdpt_film* film, std::uint32_t number, bool partial, double& lost) {
  const bdpt_film_info info = film_info(film);
  std::vector<bdpt_coverage> entries(std::size_t{info.width} * info.height * kCoverageRanks);
  auto desc = sized<bdpt_coverage_desc>();
  desc.coverage = number;
  desc.ranks = kCoverageRanks;
  desc.include_partial = partial;
  check(bdpt_film_read_coverage(film, &desc, entries.data(), entries.size(), &lost), "reading the film");
  return entries;
}

std::map<std::uint64_t, std::string> names_of(const SceneDescription& scene, bdpt_output_kind kind) {
  std::map<std::uint64_t, std::string> names;
  for (const InstanceDescription& instance : scene.instances) {
    if (instance.id.id == 0) continue;  // not in the library's scene
    if (kind == BDPT_OUTPUT_MATERIAL_COVERAGE) {
      const std::string& label = scene.materials[static_cast<std::size_t>(instance.material)].label;
      names[instance.material_id.id] = label.empty() ? "material " + std::to_string(instance.material) : label;
      continue;
    }
    const std::string& name = instance.node_name.empty() ? instance.label : instance.node_name;
    names[instance.id.id] = name.empty() ? "object " + std::to_string(instance.node) : name;
  }
  return names;
}

}  // namespace

RenderOutputs::RenderOutputs(const std::string& names, bool denoise) : denoise_(denoise) {
  std::istringstream list(names);
  std::set<std::string> known;
  for (std::string name; std::getline(list, name, ',');) {
    if (!known.insert(name).second) throw Error(ExitCode::kUsage, "--outputs: '" + name + "' is there twice");
    add(name);
  }
  if (!denoise) return;
  if (!bdpt_has_denoiser()) {
    throw Error(ExitCode::kUsage,
                "--denoise needs Open Image Denoise, which is not there: install its library, libOpenImageDenoise "
                "(version 1.4 or 2), or leave --denoise out");
  }
  color_ = add_plane(BDPT_OUTPUT_RADIANCE, BDPT_LIGHT_PATHS_ALL, 0, true);
  albedo_ = add_plane(BDPT_OUTPUT_ALBEDO, BDPT_LIGHT_PATHS_ALL, 0, true);
  normal_ = add_plane(BDPT_OUTPUT_NORMAL, BDPT_LIGHT_PATHS_ALL, 0, true);
}

std::uint32_t RenderOutputs::add_plane(bdpt_output_kind kind, bdpt_light_paths paths, std::uint64_t groups,
                                       bool unfiltered) {
  auto desc = sized<bdpt_output_desc>();
  desc.kind = kind;
  desc.paths = paths;
  desc.groups = groups;
  desc.unfiltered = unfiltered;
  descs_.push_back(desc);
  return is_coverage(kind) ? coverages_++ : planes_++;
}

void RenderOutputs::add(const std::string& name) {
  struct Kind {
    const char* name;
    const char* layer;
    const std::vector<std::string>& channels;
    bdpt_output_kind kind;
    bdpt_light_paths paths;
  };
  static const std::vector<std::string> kDepth = {"Z"}, kNone;
  static const Kind kKinds[] = {
      {"albedo", "albedo", kColors, BDPT_OUTPUT_ALBEDO, BDPT_LIGHT_PATHS_ALL},
      {"normal", "N", kVector, BDPT_OUTPUT_NORMAL, BDPT_LIGHT_PATHS_ALL},
      {"depth", "depth", kDepth, BDPT_OUTPUT_DEPTH, BDPT_LIGHT_PATHS_ALL},
      {"position", "P", kVector, BDPT_OUTPUT_POSITION, BDPT_LIGHT_PATHS_ALL},
      {"direct", "direct", kColors, BDPT_OUTPUT_RADIANCE, BDPT_LIGHT_PATHS_DIRECT},
      {"indirect", "indirect", kColors, BDPT_OUTPUT_RADIANCE, BDPT_LIGHT_PATHS_INDIRECT},
      {"cryptoobject", "CryptoObject", kNone, BDPT_OUTPUT_INSTANCE_COVERAGE, BDPT_LIGHT_PATHS_ALL},
      {"cryptomaterial", "CryptoMaterial", kNone, BDPT_OUTPUT_MATERIAL_COVERAGE, BDPT_LIGHT_PATHS_ALL},
  };
  if (name == "samples") {
    samples_ = true;
    return;
  }
  for (const Kind& k : kKinds)
    if (name == k.name) {
      outputs_.push_back({k.layer, k.channels, add_plane(k.kind, k.paths), k.kind});
      return;
    }
  unsigned group = 0;
  const char* end = name.data() + name.size();
  if (name.starts_with("group:")) {
    const auto result = std::from_chars(name.data() + 6, end, group);
    if (result.ec != std::errc() || result.ptr != end || group > 63)
      throw Error(ExitCode::kUsage, "--outputs: '" + name + "' names no group: write group:0 to group:63");
    outputs_.push_back({"group" + std::to_string(group), kColors,
                        add_plane(BDPT_OUTPUT_RADIANCE, BDPT_LIGHT_PATHS_ALL, std::uint64_t{1} << group),
                        BDPT_OUTPUT_RADIANCE});
    return;
  }
  throw Error(ExitCode::kUsage, "--outputs: '" + name +
                                    "' is not known; choose among albedo, normal, depth, position, direct, indirect, "
                                    "group:N, cryptoobject, cryptomaterial, samples");
}

void RenderOutputs::add_to(bdpt_camera_desc& camera) const {
  // Samples are counted where there is any output; this one costs least.
  static const bdpt_output_desc kDepth = [] {
    auto desc = sized<bdpt_output_desc>();
    desc.kind = BDPT_OUTPUT_DEPTH;
    return desc;
  }();
  camera.outputs = descs_.data();
  camera.output_count = static_cast<std::uint32_t>(descs_.size());
  if (descs_.empty() && samples_) camera.outputs = &kDepth, camera.output_count = 1;
}

Image RenderOutputs::denoised(const bdpt_film* film, bool partial, std::uint32_t threads) const {
  if (!denoise_) return {};
  Image color = read_plane(film, BDPT_LAYER_COLOR, color_, partial);
  const Image albedo = read_plane(film, BDPT_LAYER_COLOR, albedo_, partial),
              normal = read_plane(film, BDPT_LAYER_COLOR, normal_, partial);
  auto desc = sized<bdpt_denoise_desc>();
  desc.width = color.width;
  desc.height = color.height;
  desc.color = desc.output = color.pixels.data();
  desc.albedo = albedo.pixels.data();
  desc.normal = normal.pixels.data();
  desc.threads = threads;
  check(bdpt_denoise(&desc), "the denoiser");
  return color;
}

void RenderOutputs::write(const std::string& path, const bdpt_film* film, bool partial, const bdpt_context* context,
                          const SceneDescription& scene, const Image& denoised) const {
  std::deque<Image> images;
  std::deque<Matte> mattes;
  std::vector<ExrChannel> channels;
  std::map<std::string, std::string> attributes;
  const auto add = [&](const std::string& layer, const std::vector<std::string>& names, Image image) {
    images.push_back(std::move(image));
    for (std::size_t c = 0; c < names.size(); ++c)
      channels.push_back({layer.empty() ? names[c] : layer + '.' + names[c], images.back().pixels.data() + c, 3});
  };
  add(denoised.pixels.empty() ? "" : "noisy", kColors, read_layer(film, BDPT_LAYER_COLOR, partial));
  if (!denoised.pixels.empty()) add("", kColors, denoised);
  if (film_info(film).relative_error >= 0) add("variance", kColors, read_layer(film, BDPT_LAYER_VARIANCE, partial));
  if (samples_) add("samples", {"Y"}, read_plane(film, BDPT_LAYER_SAMPLES, 0, partial));
  for (const Output& output : outputs_) {
    if (!is_coverage(output.kind)) {
      Image image = read_plane(film, BDPT_LAYER_COLOR, output.number, partial);
      if (output.kind == BDPT_OUTPUT_DEPTH) finish_depth(image);
      add(output.layer, output.channels, std::move(image));
      continue;
    }
    double lost = 0;
    const std::vector<bdpt_coverage> entries = read_coverage(film, output.number, partial, lost);
    Matte& matte = mattes.emplace_back(make_matte(output.layer, entries, kCoverageRanks, names_of(scene, output.kind)));
    if (const double part = lost + matte.left_out; part > 0) {
      std::fprintf(stderr, "bdpt: %s leaves out %.3g of the picture, where a pixel has more names than %zu\n",
                   output.layer.c_str(), part, Matte::kRanks);
    }
    attributes.insert(matte.attributes.begin(), matte.attributes.end());
    for (std::size_t c = 0; c < 2 * Matte::kRanks; ++c)
      channels.push_back({output.layer + '0' + std::to_string(c / 4) + '.' + "RGBA"[c % 4], matte.ranks.data() + c,
                          2 * Matte::kRanks});
  }
  auto color = sized<bdpt_color_info>();
  check(bdpt_color_get_info(context, &color), "the colour space");
  const Image& first = images.front();
  write_exr_channels(path, first.width, first.height, channels, attributes, color.chromaticities);
}

}  // namespace bdpt_tool
