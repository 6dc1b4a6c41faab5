#include "bake/vertex_basis.h"

#include "sampling/hash.h"

namespace bdpt {

namespace {

uint64_t count_vertices(const Scene& scene, const std::vector<ReceivingInstance>& instances) {
  uint64_t n = 0;
  for (const ReceivingInstance& i : instances) n += scene.mesh(i.instance)->positions.size();
  return n;
}

uint64_t count_corners(const Scene& scene, const std::vector<ReceivingInstance>& instances) {
  uint64_t n = 0;
  for (const ReceivingInstance& i : instances) n += 3 * scene.mesh(i.instance)->triangles.size();
  return n;
}

std::array<uint32_t, 3> corners_of(const Triangle& t) { return {t.a, t.b, t.c}; }

// The barycentric coordinate of a corner, with a density in the triangle that is proportional to it: 6 b (1 - b).
double sample_hat(double u) { return 0.5 - std::sin(std::asin(1 - 2 * u) / 3); }

}  // namespace

VertexBasis::VertexBasis(std::shared_ptr<const Scene> scene, const std::vector<ReceivingInstance>& instances,
                         const std::vector<OutputDesc>& outputs, bool geometric_normals,
                         const std::shared_ptr<MemoryMeter>& meter)
    : SurfaceSensor(std::move(scene), instances, outputs, geometric_normals),
      by_instance_(scene_->instance_count(), -1),
      rows_(count_vertices(*scene_, instances)) {
  booking_ = Booking(meter, rows_.count * 32 + count_corners(*scene_, instances) * sizeof(Corner), "the vertices");
  hash_ = hash_combine(base_hash(), 0x7665727469636573ull);
  uint64_t first = 0;
  for (const ReceivingInstance& i : instances) {
    by_instance_[i.instance] = int(placed_.size());
    placed_.push_back({i, first});
    first += scene_->mesh(i.instance)->positions.size();
    hash_ = hash_combine(hash_, hash_values(i.instance, i.flip));
  }
  collect();
}

// Calls visit(placed, primitive, its three vertices, its area in the world).
template <class Visit>
void VertexBasis::each_triangle(Visit&& visit) const {
  for (uint32_t p = 0; p < placed_.size(); ++p) {
    const Mesh& mesh = *scene_->mesh(placed_[p].instance);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto c = corners_of(mesh.triangles[t]);
      const uint64_t first = placed_[p].first;
      const double area = scene_->triangle_area(placed_[p].instance, t);
      if (area > 0) visit(p, t, std::array<uint64_t, 3>{first + c[0], first + c[1], first + c[2]}, area);
    }
  }
}

void VertexBasis::collect() {
  areas_.assign(rows_.count, 0);
  first_.assign(rows_.count + 1, 0);
  numbers_.assign(rows_.count, -1);
  each_triangle([&](uint32_t, uint32_t, const std::array<uint64_t, 3>& vertices, double) {
    for (const uint64_t v : vertices) ++first_[v + 1];
  });
  for (size_t v = 0; v < rows_.count; ++v) first_[v + 1] += first_[v];
  corners_.resize(first_.back());
  std::vector<uint64_t> next(first_.begin(), first_.end() - 1);
  each_triangle([&](uint32_t p, uint32_t t, const std::array<uint64_t, 3>& vertices, double area) {
    for (uint32_t c = 0; c < 3; ++c) {
      const uint64_t v = vertices[c];
      areas_[v] += area;
      corners_[next[v]++] = {p, t, c, areas_[v]};
    }
  });
  for (uint64_t v = 0; v < rows_.count; ++v) {
    if (!(areas_[v] > 0)) continue;
    areas_[v] /= 3;
    numbers_[v] = int64_t(measured_.size());
    measured_.push_back(v);
  }
}

EyeStart VertexBasis::start_at(int x, int y, const float u[5]) const {
  const uint64_t vertex = uint64_t(rows_.number(x, y));
  const auto begin = corners_.begin() + int64_t(first_[vertex]), end = corners_.begin() + int64_t(first_[vertex + 1]);
  const double all = (end - 1)->until, place = double(u[0]) * all;
  const auto found =
      std::min(std::upper_bound(begin, end, place, [](double v, const Corner& c) { return v < c.until; }), end - 1);
  const double before = found == begin ? 0 : (found - 1)->until;
  const double rest = std::clamp((place - before) / (found->until - before), 0.0, 1.0);
  double b[3];
  b[found->corner] = sample_hat(rest);
  b[(found->corner + 1) % 3] = (1 - b[found->corner]) * double(u[1]);
  b[(found->corner + 2) % 3] = (1 - b[found->corner]) * (1 - double(u[1]));
  EyeStart s = start_on(placed_[found->placed], found->primitive, float(b[1]), float(b[2]), u + 2);
  s.film = center_of(x, y);
  s.density_position = float(1 / areas_[vertex]);
  return s;
}

bool VertexBasis::land(const Landing& landing, SensorPoint& z0) const {
  const int index = by_instance_[landing.instance];
  if (index < 0) return false;
  const Placed& placed = placed_[size_t(index)];
  if (!receive(placed, landing, z0)) return false;
  const auto corners = corners_of(scene_->mesh(placed.instance)->triangles[landing.primitive]);
  const uint32_t corner = landing.chance < landing.u ? 1 : landing.chance < landing.u + landing.v ? 2 : 0;
  const uint64_t vertex = placed.first + corners[corner];
  if (!(areas_[vertex] > 0)) return false;
  z0.film = rows_.place(vertex);
  z0.importance = z0.density_position = float(1 / areas_[vertex]);
  return true;
}

// Conjugate gradients (Hestenes and Stiefel 1952) on D^-1/2 M D^-1/2, D the diagonal of M, whose eigenvalues lie within
// [1/2, 2] for any mesh (Wathen 1987): some thirty steps reach a float's rounding.
void VertexBasis::solve(float* values, uint32_t channel, uint32_t channels) const {
  constexpr int kMostSteps = 100;
  constexpr double kEnough = 1e-9;
  const size_t n = areas_.size();
  std::vector<double> v(n), residual(n), direction(n), product(n);
  const auto multiply = [&](const std::vector<double>& x, std::vector<double>& out) {
    std::fill(out.begin(), out.end(), 0.0);
    each_triangle([&](uint32_t, uint32_t, const std::array<uint64_t, 3>& t, double area) {
      const double sum = x[t[0]] + x[t[1]] + x[t[2]];
      for (const uint64_t j : t) out[j] += area / 12 * (sum + x[j]);
    });
  };
  // D_j = SUM area / 6 = INT h_j / 2.
  const auto inner = [&](const std::vector<double>& r) {
    double sum = 0;
    for (size_t j = 0; j < n; ++j)
      if (areas_[j] > 0) sum += r[j] * r[j] / (areas_[j] / 2);
    return sum;
  };
  for (size_t j = 0; j < n; ++j) v[j] = areas_[j] > 0 ? double(values[j * channels + channel]) : 0;
  multiply(v, product);  // the means are the first guess
  std::vector<double> load(n);
  for (size_t j = 0; j < n; ++j) load[j] = areas_[j] * v[j], residual[j] = load[j] - product[j];
  for (size_t j = 0; j < n; ++j) direction[j] = areas_[j] > 0 ? residual[j] / (areas_[j] / 2) : 0;
  double squares = inner(residual);
  const double enough = inner(load) * kEnough * kEnough;
  for (int step = 0; step < kMostSteps && squares > enough; ++step) {
    multiply(direction, product);
    double along = 0;
    for (size_t j = 0; j < n; ++j) along += direction[j] * product[j];
    const double length = squares / along;
    for (size_t j = 0; j < n; ++j) v[j] += length * direction[j], residual[j] -= length * product[j];
    const double next = inner(residual);
    for (size_t j = 0; j < n; ++j)
      direction[j] = areas_[j] > 0 ? residual[j] / (areas_[j] / 2) + next / squares * direction[j] : 0;
    squares = next;
  }
  for (size_t j = 0; j < n; ++j)
    if (areas_[j] > 0) values[j * channels + channel] = float(std::clamp(v[j], -3e38, 3e38));
}

}  // namespace bdpt
