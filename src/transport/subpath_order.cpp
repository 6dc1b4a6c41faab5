#include "transport/subpath_order.h"

#include <algorithm>
#include <array>
#include <bit>

namespace bdpt {

namespace {

constexpr int kBits = 21;

const Vec3& origin(const EyeStart& z0) { return z0.p; }
const Vec3& origin(const LightStart& y0) { return y0.origin; }

uint64_t place_on_curve(const Vec3& p, const SceneInfo& scene) {
  uint32_t cell[3];
  for (int i = 0; i < 3; ++i) {
    const double low = scene.bounds_min[i], extent = scene.bounds_max[i] - low, cells = double(1u << kBits);
    cell[i] = extent > 0 ? uint32_t(std::clamp((p[i] - low) / extent * cells, 0.0, cells - 1)) : 0;
  }
  return hilbert_index(cell[0], cell[1], cell[2]);
}

// Stable, by the digits of the keys from the last to the first; equal keys stay as they are.
struct Key {
  uint64_t key;
  OrderedVertex vertex;
};
void sort_by_key(std::vector<Key>& keys, std::vector<Key>& other, int bits) {
  constexpr int kDigit = 11;
  other.resize(keys.size());
  for (int shift = 0; shift < bits; shift += kDigit) {
    std::array<uint32_t, (1 << kDigit) + 1> begin{};
    const auto digit = [&](const Key& k) { return (k.key >> shift) & ((1u << kDigit) - 1); };
    for (const Key& k : keys) ++begin[digit(k) + 1];
    for (size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    for (const Key& k : keys) other[begin[digit(k)]++] = k;
    std::swap(keys, other);
  }
}

template <class Start>
void order_by(const Subpaths<Start>& subpaths, const SceneInfo& scene, Order order, Lengths lengths,
              OrderedVertices& result) {
  const std::vector<Vertex>& vertices = subpaths.vertices;
  std::vector<uint32_t> sample(vertices.size());
  for (uint32_t n = 0; n < subpaths.count(); ++n)
    for (uint32_t i = subpaths.last[n]; i != kNoVertex; i = vertices[i].previous_index) sample[i] = n;
  // A vertex comes after those before it on its subpath, and those of one length come by the numbers of their subpaths.
  std::vector<float> metric(order == Order::Metric ? vertices.size() : 0);
  std::vector<std::vector<Key>> keys(1);
  for (uint32_t i = 0; i < vertices.size(); ++i) {
    const Vertex& v = vertices[i];
    const uint32_t before = v.previous_index;
    uint64_t key = 0;
    if (order == Order::Metric) {
      metric[i] = before == kNoVertex ? length_squared(v.p - origin(subpaths.starts[sample[i]]))
                                      : metric[before] + length_squared(v.p - vertices[before].p);
      key = std::bit_cast<uint32_t>(metric[i]);  // of numbers that are not negative: in their order
    }
    if (!v.is_joinable()) continue;
    if (order == Order::Hilbert) key = place_on_curve(v.p, scene);
    const uint32_t n = lengths == Lengths::Apart ? v.count : 0;
    if (keys.size() <= n) keys.resize(n + 1);
    keys[n].push_back({key, {i, sample[i]}});
  }
  std::vector<Key> other;
  result.resize(keys.size());
  for (size_t n = 0; n < keys.size(); ++n) {
    if (order != Order::None) sort_by_key(keys[n], other, order == Order::Metric ? 32 : 3 * kBits);
    result[n].clear();
    for (const Key& k : keys[n]) result[n].push_back(k.vertex);
  }
}

}  // namespace

uint64_t hilbert_index(uint32_t x, uint32_t y, uint32_t z) {
  uint32_t v[3] = {x, y, z};
  constexpr uint32_t top = 1u << (kBits - 1);
  for (uint32_t q = top; q > 1; q >>= 1) {
    const uint32_t below = q - 1;
    for (uint32_t& c : v) {
      if (c & q) {
        v[0] ^= below;
      } else {
        const uint32_t t = (v[0] ^ c) & below;
        v[0] ^= t;
        c ^= t;
      }
    }
  }
  v[1] ^= v[0];
  v[2] ^= v[1];
  uint32_t t = 0;
  for (uint32_t q = top; q > 1; q >>= 1)
    if (v[2] & q) t ^= q - 1;
  uint64_t index = 0;
  for (int bit = kBits - 1; bit >= 0; --bit)
    for (const uint32_t c : v) index = index << 1 | (((c ^ t) >> bit) & 1u);
  return index;
}

void order_subpaths(const EyeSubpaths& subpaths, const SceneInfo& scene, Order order, Lengths lengths,
                    OrderedVertices& result) {
  order_by(subpaths, scene, order, lengths, result);
}
void order_subpaths(const LightSubpaths& subpaths, const SceneInfo& scene, Order order, Lengths lengths,
                    OrderedVertices& result) {
  order_by(subpaths, scene, order, lengths, result);
}

}  // namespace bdpt
