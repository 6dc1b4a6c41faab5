// The connection matrix of the door scene as a picture: Chaitanya et al. (2018), figure 4.
//
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>

#include "api/handles.h"
#include "rows/rows.h"
#include "sampling/hash.h"
#include "scenes/scenes.h"
#include "tables.h"
#include "transport/plan.h"
#include "transport/subpath_order.h"

namespace bdpt_experiments {
namespace {

// The paper counts edges from both ends, (1,3); in vertices, as here, it is (s,t) = (4,2).
constexpr std::uint32_t kLightVertices = 4, kEyeVertices = 2;
constexpr int kMaxEdges = 6;

struct Subpaths {
  bdpt::EyeSubpaths eye;
  bdpt::LightSubpaths light;
};

// A plan that joins nothing and keeps the subpaths of the one block that the whole picture is.
Subpaths* kept = nullptr;
// The materials are the scene's: none of them varies over a surface.
template <class T>
void copy_subpaths(const T& from, T& to) {
  to.starts = from.starts;
  to.streams = from.streams;
  to.vertices = from.vertices;
  to.last = from.last;
}
void keep(bdpt::Block& block) {
  copy_subpaths(block.eye(), kept->eye);
  copy_subpaths(block.light(), kept->light);
}
bdpt::SampleCounts counts(const bdpt::TransportOptions&, double) { return {}; }
const bdpt::Plan kKeep = {.name = "keep",
                          .summary = "",
                          .serves = bdpt::serves_all,
                          .counts = counts,
                          .connect = keep,
                          .block_size = 1u << 20};

void trace(const Stage& stage, Subpaths& subpaths) {
  const auto& meter = stage.context->meter;
  bdpt::FilmDesc film;
  film.width = int(stage.width), film.height = int(stage.height);
  film.filter.type = bdpt::FilterType::Box;
  bdpt::RenderDesc desc;
  desc.transport.plan = &kKeep;
  desc.transport.max_edges = kMaxEdges;
  desc.transport.sampler = bdpt::SamplerType::Independent;
  bdpt::Render render(stage.scene->scene, stage.sensor->sensor, std::make_shared<bdpt::Film>(film, meter),
                      bdpt::make_pool(1), meter, desc);
  bdpt::AdvanceDesc advance;
  advance.passes = 1;
  kept = &subpaths;
  render.advance(advance);
}

// n vertices of all, chosen by chance, the same whatever the order. `shuffle`: in the order of chance, too, for samples
// are numbered along the picture's rows.
std::vector<std::uint32_t> choose(const std::vector<bdpt::OrderedVertex>& all, std::size_t n, bool shuffle) {
  const auto chance = [](const bdpt::OrderedVertex& v) { return bdpt::mix64(v.sample); };
  std::vector<bdpt::OrderedVertex> chosen = all;
  std::sort(chosen.begin(), chosen.end(), [&](const auto& a, const auto& b) { return chance(a) < chance(b); });
  const std::uint64_t end = n < chosen.size() ? chance(chosen[n]) : ~0ull;
  std::vector<std::uint32_t> vertices;
  for (const bdpt::OrderedVertex& v : shuffle ? chosen : all)
    if (chance(v) < end) vertices.push_back(v.vertex);
  return vertices;
}

// The decimal logarithm of what the connection carries, unweighted; -inf for none.
float log_contribution(const bdpt::Vertex& y, const bdpt::Vertex& z) {
  const bdpt::Vec3 edge = z.p - y.p;
  const float d2 = bdpt::length_squared(edge);
  const bdpt::Vec3 w = edge * (1 / std::sqrt(d2));
  bdpt::Scattering at_y, at_z;
  if (!scatter(y, w, bdpt::TransportMode::Importance, at_y) || !scatter(z, -w, bdpt::TransportMode::Radiance, at_z))
    return -INFINITY;
  const float geometry = bdpt::absdot(y.ng, w) * bdpt::absdot(z.ng, w) / d2;
  const bdpt::Rgb c = y.throughput * at_y.f * (at_z.f * z.throughput) * geometry;
  return std::log10(c.r + c.g + c.b);
}

// Entry (row, column) at row * columns + column.
using Matrix = std::vector<float>;

Matrix connect(const Subpaths& subpaths, const std::vector<std::uint32_t>& rows,
               const std::vector<std::uint32_t>& columns) {
  Matrix matrix;
  matrix.reserve(rows.size() * columns.size());
  for (const std::uint32_t z : rows)
    for (const std::uint32_t y : columns)
      matrix.push_back(log_contribution(subpaths.light.vertices[y], subpaths.eye.vertices[z]));
  return matrix;
}

// The five decades below the largest but one in a hundred become [0, 1].
void normalise(Matrix& matrix) {
  Matrix sorted = matrix;
  const auto top = sorted.begin() + std::ptrdiff_t(sorted.size() * 99 / 100);
  std::nth_element(sorted.begin(), top, sorted.end());
  for (float& x : matrix) x = std::clamp(1 + (x - *top) / 5, 0.f, 1.f);
}

// Of each entry with the one below it: how alike neighbouring rows are.
double neighbour_correlation(const Matrix& m, std::size_t columns, std::size_t step) {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i + step < m.size(); ++i) {
    if (step == 1 && (i + 1) % columns == 0) continue;
    const double x = m[i], y = m[i + step];
    n += 1, a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
  }
  return (ab / n - a / n * (b / n)) / std::sqrt((aa / n - a / n * (a / n)) * (bb / n - b / n * (b / n)));
}

// Each third entry or so: an average would hide what is rough.
bdpt_tool::Image picture_of(const Matrix& matrix, std::size_t rows, std::size_t columns) {
  const std::size_t step = std::max<std::size_t>(1, std::min(rows, columns) / 432);
  bdpt_tool::Image image(std::uint32_t(columns / step), std::uint32_t(rows / step));
  for (std::size_t y = 0; y < image.height; ++y)
    for (std::size_t x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const float value = matrix[y * step * columns + x * step];
        image.pixels[3 * (y * image.width + x) + std::size_t(c)] = value * value;  // near the display's own curve
      }
  return image;
}

}  // namespace

void matrix_picture(Report& report) {
  const Setting& setting = report.setting();
  const std::size_t size = setting.pick(1728, 864, 40);
  const Stage stage = build_stage(bitterli_scene(setting, "veach-ajar"), setting.pick(128, 96, 24), setting);
  Subpaths subpaths;
  trace(stage, subpaths);
  Table table{"Correlation of neighbours, of the logarithm of what they carry",
              {"order", "neighbouring rows (eye)", "neighbouring columns (light)"},
              {}};
  std::vector<bdpt_tool::Image> pictures;
  std::vector<std::pair<double, double>> alike;  // of rows and of columns, for each order
  std::string shape;
  const std::pair<bdpt::Order, const char*> orders[] = {
      {bdpt::Order::None, "as sampled"}, {bdpt::Order::Metric, "metric"}, {bdpt::Order::Hilbert, "Hilbert"}};
  for (const auto& [order, name] : orders) {
    const bool shuffle = order == bdpt::Order::None;
    bdpt::OrderedVertices eye, light;
    order_subpaths(subpaths.eye, stage.scene->scene->info(), order, bdpt::Lengths::Apart, eye);
    order_subpaths(subpaths.light, stage.scene->scene->info(), order, bdpt::Lengths::Apart, light);
    const auto rows = choose(eye[kEyeVertices], size, shuffle), columns = choose(light[kLightVertices], size, shuffle);
    Matrix matrix = connect(subpaths, rows, columns);
    normalise(matrix);
    const double along_eye = neighbour_correlation(matrix, columns.size(), columns.size());
    const double along_light = neighbour_correlation(matrix, columns.size(), 1);
    table.rows.push_back({std::string(name), along_eye, along_light});
    alike.push_back({along_eye, along_light});
    pictures.push_back(picture_of(matrix, rows.size(), columns.size()));
    shape =
        std::to_string(rows.size()) + " eye subpaths (rows) and " + std::to_string(columns.size()) + " light subpaths";
  }
  report.measured("Bitterli's door ajar; " + shape +
                  " of the paper's (1,3), 2 eye and 4 light vertices. An entry is the " +
                  "unweighted contribution without its visibility, five decades from black to white.");
  report.add(std::move(table));
  report.compare("As sampled, and by the metric", "as sampled", pictures[0], "metric", pictures[1], 0);
  report.compare("By the metric, and along a Hilbert curve", "metric", pictures[1], "Hilbert curve", pictures[2], 0);
  const bool eye = alike[1].first > alike[0].first + 0.2, light = alike[1].second > alike[0].second + 0.2;
  const auto both = [&](std::size_t i) {
    return text(Estimate{alike[i].first, 0}) + " and " + text(Estimate{alike[i].second, 0});
  };
  report.verdict(eye && light   ? Verdict::Agrees
                 : eye || light ? Verdict::Partly
                                : Verdict::Differs,
                 "Neighbouring rows and columns correlate by " + both(0) + " as sampled, " + both(1) +
                     " by the metric, " + both(2) + " along the Hilbert curve.");
}

}  // namespace bdpt_experiments
