// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "bake_target.h"
#include "json.h"
#include "output_path.h"
#include "point_list.h"
#include "whole_file.h"

namespace bdpt_tool {
namespace {

constexpr std::uint64_t kMaxProbes = 1u << 26;

// --what probes and --what points.
class PointsTarget : public BakeTarget {
 public:
  explicit PointsTarget(const BakeOptions& options) : options_(options) {
    check_options();
    if (!options.points.empty()) {
      points_ = read_points(options.points);
      if (options.what == "probes" && has_normal(points_[0]))
        throw Error(Location{options.points, 0}, "probes have no normals; use --what points, or leave them out");
    } else {
      read_grid();
    }
    const char* usual = options.what == "probes" ? "sh2" : has_normal(points_[0]) ? "e" : "fluence";
    outputs_ = bake_outputs(options, usual);
  }

  Sensor make_sensor(bdpt_context* context, bdpt_scene* scene, const SceneDescription&) override {
    if (options_.points.empty() && options_.box.empty()) put_in_bounds(scene);
    std::vector<bdpt_output_desc> outputs;
    for (const BakeOutput& output : outputs_) outputs.push_back(output.desc);
    auto desc = sized<bdpt_points_desc>();
    desc.points = points_.data();
    desc.count = points_.size();
    desc.outputs = outputs.data();
    desc.output_count = static_cast<std::uint32_t>(outputs.size());
    return make<Sensor>("the points", bdpt_points_create, context, &desc);
  }

  void write(const bdpt_film* film, bool partial) override {
    std::vector<Image> planes;
    std::vector<std::string> names;
    for (const BakeOutput& output : outputs_)
      for (const std::string& layer : output.layers) {
        planes.push_back(read_plane(film, static_cast<std::uint32_t>(planes.size()), partial));
        names.push_back(layer);
      }
    const std::string& path = options_.render.output;
    if (path.ends_with(".json")) return write_json(path, planes, names);
    if (path.ends_with(".csv")) return write_csv(path, planes, names);
    planes.push_back(of_points(&bdpt_point::position));
    names.emplace_back("position");
    if (has_normal(points_[0])) {
      planes.push_back(of_points(&bdpt_point::normal));
      names.emplace_back("normal");
    }
    write_layers(path, planes, names);
  }

 private:
  void check_options() const {
    const auto refuse = [&](bool given, const char* option) {
      if (given)
        throw Error(ExitCode::kUsage, std::string(option) + " is for lightmaps, not for --what " + options_.what);
    };
    refuse(!options_.render.png.empty(), "--png");
    refuse(options_.files, "--files");
    refuse(options_.resolution > 0, "--resolution");
    refuse(options_.texels_per_unit > 0, "--texels-per-unit");
    refuse(!options_.subset.empty(), "--subset");
    refuse(options_.geometric_normals, "--geometric-normals");
    const std::string extension = std::filesystem::path(options_.render.output).extension().string();
    if (extension != ".exr" && extension != ".json" && extension != ".csv")
      throw Error(ExitCode::kUsage, "--output: '" + options_.render.output + "' must end in .exr, .json or .csv");
    const bool probes = options_.what == "probes";
    if (!options_.points.empty() && !options_.grid.empty())
      throw Error(ExitCode::kUsage, "--grid and --points: give one of them");
    if (options_.points.empty() && (options_.grid.empty() || !probes))
      throw Error(ExitCode::kUsage, probes ? "--what probes needs --grid NX,NY,NZ, or --points FILE"
                                           : "--what points needs --points FILE");
    if (!options_.box.empty() && options_.grid.empty()) throw Error(ExitCode::kUsage, "--box needs --grid NX,NY,NZ");
  }

  static std::vector<double> numbers_of(const char* option, const std::string& text, std::size_t count) {
    try {
      const std::vector<double> numbers = parse_numbers(text);
      if (numbers.size() == count) return numbers;
    } catch (const std::invalid_argument& error) {
      throw Error(ExitCode::kUsage, std::string(option) + ": " + error.what());
    }
    throw Error(ExitCode::kUsage, std::string(option) + ": give " + std::to_string(count) + " numbers with commas");
  }

  void read_grid() {
    const std::vector<double> cells = numbers_of("--grid", options_.grid, 3);
    std::uint64_t count = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(cells[i] >= 1 && cells[i] <= 65536 && cells[i] == static_cast<std::uint32_t>(cells[i])))
        throw Error(ExitCode::kUsage, "--grid: give three whole numbers from 1 to 65536");
      cells_[i] = static_cast<std::uint32_t>(cells[i]);
      count *= cells_[i];
      if (count > kMaxProbes)
        throw Error(ExitCode::kUsage,
                    "--grid: more than " + std::to_string(kMaxProbes) + " probes; bake boxes of them");
    }
    std::array<double, 6> box = {0, 0, 0, 1, 1, 1};
    if (!options_.box.empty()) {
      const std::vector<double> given = numbers_of("--box", options_.box, 6);
      std::copy(given.begin(), given.end(), box.begin());
      for (std::size_t i = 0; i < 3; ++i)
        if (!(box[3 + i] >= box[i]))
          throw Error(ExitCode::kUsage, "--box: give x0,y0,z0,x1,y1,z1 with x0 <= x1 and so on");
    }
    points_ = grid_points(cells_, box);
  }

  void put_in_bounds(const bdpt_scene* scene) {
    auto info = sized<bdpt_scene_info>();
    check(bdpt_scene_get_info(scene, &info), "the scene");
    std::array<double, 6> box{};
    std::copy_n(info.bounds_min, 3, box.begin());
    std::copy_n(info.bounds_max, 3, box.begin() + 3);
    points_ = grid_points(cells_, box);
  }

  // Pictures of probes have the grid's x across, and its layers one below the other; those of points the film's shape.
  Image blank() const {
    if (options_.points.empty()) return {cells_[0], cells_[1] * cells_[2]};
    const auto width = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(points_.size()))));
    return {width, static_cast<std::uint32_t>((points_.size() + width - 1) / width)};
  }
  Image read_plane(const bdpt_film* film, std::uint32_t plane, bool partial) const {
    const bdpt_film_info info = film_info(film);
    std::vector<float> values(std::size_t{3} * info.width * info.height);
    auto desc = sized<bdpt_read_desc>();
    desc.plane = plane;
    desc.include_partial = partial;
    check(bdpt_film_read(film, &desc, values.data(), values.size() * sizeof(float)), "the film");
    Image image = blank();
    std::copy_n(values.begin(), 3 * points_.size(), image.pixels.begin());
    return image;
  }
  Image of_points(float (bdpt_point::*triple)[3]) const {
    Image image = blank();
    for (std::size_t i = 0; i < points_.size(); ++i) std::copy_n(points_[i].*triple, 3, &image.pixels[3 * i]);
    return image;
  }

  void write_json(const std::string& path, const std::vector<Image>& planes,
                  const std::vector<std::string>& names) const {
    JsonWriter json;
    if (options_.points.empty())
      json.array("grid", std::array<double, 3>{double(cells_[0]), double(cells_[1]), double(cells_[2])});
    json.open_list("points");
    for (std::size_t i = 0; i < points_.size(); ++i) {
      json.open();
      json.array("position", points_[i].position);
      if (has_normal(points_[i])) json.array("normal", points_[i].normal);
      for (std::size_t p = 0; p < planes.size(); ++p) json.array(names[p], rgb(planes[p], i));
      json.close();
    }
    json.close_list();
    const std::string text = std::move(json).finish();
    write_whole_file(path, [&](std::ofstream& out) { out << text; });
  }

  void write_csv(const std::string& path, const std::vector<Image>& planes,
                 const std::vector<std::string>& names) const {
    const bool normals = has_normal(points_[0]);
    write_whole_file(path, [&](std::ofstream& out) {
      out << "x,y,z" << (normals ? ",nx,ny,nz" : "");
      for (const std::string& name : names)
        for (const char* channel : {".R", ".G", ".B"}) out << ',' << name << channel;
      out << '\n';
      for (std::size_t i = 0; i < points_.size(); ++i) {
        std::string line;
        append(line, points_[i].position);
        if (normals) append(line, points_[i].normal);
        for (const Image& plane : planes) append(line, rgb(plane, i));
        line.back() = '\n';
        out << line;
      }
    });
  }

  static std::array<float, 3> rgb(const Image& image, std::size_t i) {
    return {image.pixels[3 * i], image.pixels[3 * i + 1], image.pixels[3 * i + 2]};
  }
  template <class Triple>
  static void append(std::string& line, const Triple& values) {
    for (const float value : values) {
      char text[32];
      line.append(text, std::to_chars(text, text + sizeof text, value).ptr);
      line += ',';
    }
  }

  const BakeOptions& options_;
  std::vector<BakeOutput> outputs_;
  std::vector<bdpt_point> points_;
  std::array<std::uint32_t, 3> cells_{};
};

}  // namespace

std::unique_ptr<BakeTarget> points_target(const BakeOptions& options) {
  return std::make_unique<PointsTarget>(options);
}

}  // namespace bdpt_tool
