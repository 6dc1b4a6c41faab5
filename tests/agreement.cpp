#include "agreement.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bdpt_tool {
namespace {

constexpr std::uint32_t kBlock = 32;

std::vector<float> read_layer(const bdpt_film* film, std::uint32_t width, std::uint32_t height, bdpt_layer layer,
                              std::uint32_t s = 0, std::uint32_t t = 0) {
  std::vector<float> pixels(std::size_t{3} * width * height);
  auto desc = sized<bdpt_read_desc>();
  desc.layer = layer;
  desc.s = s;
  desc.t = t;
  check(bdpt_film_read(film, &desc, pixels.data(), pixels.size() * sizeof(float)), "reading the film");
  return pixels;
}

void add_blocks(const std::vector<float>& pixels, std::uint32_t width, std::uint32_t height, double factor,
                std::vector<double>& blocks) {
  const std::uint32_t columns = (width + kBlock - 1) / kBlock;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint32_t bx = x / kBlock, by = y / kBlock;
      const double area = double(std::min(kBlock, width - bx * kBlock)) * std::min(kBlock, height - by * kBlock);
      const float* p = &pixels[3 * (std::size_t{y} * width + x)];
      blocks[by * columns + bx] += factor * (double(p[0]) + p[1] + p[2]) / 3 / area;
    }
}

// The density of Student's distribution, not normalised.
double student_density(double t, double degrees) { return std::pow(1 + t * t / degrees, -(degrees + 1) / 2); }

}  // namespace

Mean mean_of(const std::vector<double>& values) {
  const double n = double(values.size());
  double mean = 0, squares = 0;
  for (double v : values) mean += v / n;
  for (double v : values) squares += (v - mean) * (v - mean);
  return {mean, std::sqrt(squares / (n - 1) / n), int(values.size()) - 1};
}

SceneUnderTest load_scene(const std::string& path, const Frame& frame, std::uint32_t max_edges,
                          Diagnostics& diagnostics) {
  std::array<std::uint32_t, 4> crop = frame.crop;
  if (crop[2] == 0) crop = {0, 0, frame.width, frame.height};
  SceneUnderTest scene{make_context(0, diagnostics), {}, {}, crop[2] - crop[0], crop[3] - crop[1], max_edges};
  SceneDescription description = read_scene(path, diagnostics);
  scene.scene = build_scene(scene.context.get(), description);
  bdpt_camera_desc camera = camera_desc(description, frame.width, frame.height, diagnostics);
  std::copy(crop.begin(), crop.end(), camera.crop);
  scene.sensor = make<Sensor>("the camera", bdpt_camera_create, scene.context.get(), &camera);
  return scene;
}

BlockMeans render_blocks(const SceneUnderTest& scene, const Variant& variant, int seeds, std::uint64_t first_seed) {
  BlockMeans means;
  means.columns = (scene.width + kBlock - 1) / kBlock;
  means.rows = (scene.height + kBlock - 1) / kBlock;
  const std::size_t blocks = std::size_t{means.columns} * means.rows;
  means.plain.resize(blocks);
  means.planted.resize(blocks);
  const bool plant = variant.planted != TechniqueMask{};

  auto film_desc = sized<bdpt_film_desc>();
  film_desc.normalization = BDPT_NORMALIZATION_SAMPLE_COUNT;
  film_desc.groups = 1;
  film_desc.pyramid_edges = plant ? scene.max_edges : 0;
  auto film = make<Film>("the film", bdpt_film_create, scene.sensor.get(), &film_desc);
  for (int seed = 0; seed < seeds; ++seed) {
    check(bdpt_film_clear(film.get()), "clearing the film");
    auto desc = sized<bdpt_render_desc>();
    desc.seed = first_seed + std::uint64_t(seed);
    desc.max_edges = scene.max_edges;
    desc.sampler = BDPT_SAMPLER_INDEPENDENT;
    std::copy(variant.techniques.begin(), variant.techniques.end(), desc.techniques);
    auto render =
        make<Render>("the render", bdpt_render_create, scene.scene.get(), scene.sensor.get(), film.get(), &desc);
    auto advance = sized<bdpt_advance_desc>();
    advance.passes = variant.passes;
    check(bdpt_render_advance(render.get(), &advance, nullptr), "rendering");

    std::vector<double> plain(blocks), planted(blocks);
    add_blocks(read_layer(film.get(), scene.width, scene.height, BDPT_LAYER_COLOR), scene.width, scene.height, 1,
               plain);
    planted = plain;
    for (std::uint32_t s = 0; plant && s <= scene.max_edges + 1; ++s)
      for (std::uint32_t t = 0; s + t <= scene.max_edges + 1; ++t)
        if (s + t >= 2 && allows(variant.planted, s, t))
          add_blocks(read_layer(film.get(), scene.width, scene.height, BDPT_LAYER_TECHNIQUE, s, t), scene.width,
                     scene.height, 0.02, planted);
    for (std::size_t b = 0; b < blocks; ++b) {
      means.plain[b].push_back(plain[b]);
      means.planted[b].push_back(planted[b]);
    }
  }
  return means;
}

double student_quantile(double chance, double degrees) {
  // The tail from the right, by the midpoint rule in 1/t, until it holds half the chance.
  constexpr int steps = 200000;
  const auto tail = [&](double t) {  // integral from t to infinity, t > 0, with v = 1/x
    double sum = 0;
    for (int i = 0; i < 2000; ++i) {
      const double v = (i + 0.5) / 2000 / t;
      sum += student_density(1 / v, degrees) / (v * v) / (2000 * t);
    }
    return sum;
  };
  double half = 0;
  for (int i = 0; i < steps; ++i) half += student_density((i + 0.5) * 1.0 / steps, degrees) / steps;
  half += tail(1);
  double low = 1, high = 100;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (tail(middle) / (2 * half) > chance / 2 ? low : high) = middle;
  }
  return low;
}

Agreement compare_blocks(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b,
                         const std::vector<std::uint32_t>& skipped, bool paired) {
  Agreement result;
  const double chance = result.family_chance / double(a.size() - skipped.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::find(skipped.begin(), skipped.end(), i) != skipped.end()) continue;
    const Mean x = mean_of(a[i]), y = mean_of(b[i]);
    const double vx = x.error * x.error, vy = y.error * y.error;
    if (!(y.value > 0)) continue;  // carries no light
    // Welch's test, or that of the differences.
    double degrees = (vx + vy) * (vx + vy) / (vx * vx / x.degrees + vy * vy / y.degrees);
    double error = std::sqrt(vx + vy);
    if (paired) {
      std::vector<double> differences;
      for (std::size_t k = 0; k < a[i].size(); ++k) differences.push_back(a[i][k] - b[i][k]);
      error = mean_of(differences).error;
      degrees = x.degrees;
    }
    const double threshold = student_quantile(chance, degrees) * error;
    result.worst = std::max(result.worst, std::fabs(x.value - y.value) / threshold);
    result.widest = std::max(result.widest, threshold / y.value);
    char line[200];
    std::snprintf(line, sizeof line,
                  "  block %2zu: %.6g and %.6g, differ by %+.3f %%, errors %.3f %% and %.3f %%, threshold %.3f %%\n", i,
                  x.value, y.value, 100 * (x.value / y.value - 1), 100 * x.error / x.value, 100 * y.error / y.value,
                  100 * threshold / y.value);
    result.table += line;
  }
  return result;
}

}  // namespace bdpt_tool
