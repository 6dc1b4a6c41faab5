#include "transport/subpath_order.h"

#include <algorithm>

namespace bdpt {

namespace {

constexpr int kBits = 21;

const Vec3& origin(const EyeStart& z0) { return z0.p; }
const Vec3& origin(const LightStart& y0) { return y0.origin; }

struct Key {
  double key;  // exact for the Hilbert curve's first 53 bits
  OrderedVertex vertex;
  bool operator<(const Key& o) const { return key != o.key ? key < o.key : vertex.sample < o.vertex.sample; }
};

double place_on_curve(const Vec3& p, const SceneInfo& scene) {
  uint32_t cell[3];
  for (int i = 0; i < 3; ++i) {
    const double low = scene.bounds_min[i], extent = scene.bounds_max[i] - low, cells = double(1u << kBits);
    cell[i] = extent > 0 ? uint32_t(std::clamp((p[i] - low) / extent * cells, 0.0, cells - 1)) : 0;
  }
  return double(hilbert_index(cell[0], cell[1], cell[2]));
}

template <class Start>
void order_by(const Subpaths<Start>& subpaths, const SceneInfo& scene, Order order, OrderedVertices& result) {
  std::vector<std::vector<Key>> keys;
  std::vector<uint32_t> chain;
  for (uint32_t sample = 0; sample < subpaths.count(); ++sample) {
    chain.clear();
    for (uint32_t i = subpaths.last[sample]; i != kNoVertex; i = subpaths.vertices[i].previous_index)
      chain.push_back(i);
    double metric = 0;
    Vec3 before = origin(subpaths.starts[sample]);
    for (auto i = chain.rbegin(); i != chain.rend(); ++i) {
      const Vertex& v = subpaths.vertices[*i];
      metric += double(length_squared(v.p - before));
      before = v.p;
      if (!v.is_joinable()) continue;
      if (keys.size() <= v.count) keys.resize(v.count + 1);
      const double key = order == Order::Metric    ? metric
                         : order == Order::Hilbert ? place_on_curve(v.p, scene)
                                                   : double(sample);
      keys[v.count].push_back({key, {*i, sample}});
    }
  }
  result.resize(keys.size());
  for (size_t n = 0; n < keys.size(); ++n) {
    std::sort(keys[n].begin(), keys[n].end());
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

void order_subpaths(const EyeSubpaths& subpaths, const SceneInfo& scene, Order order, OrderedVertices& result) {
  order_by(subpaths, scene, order, result);
}
void order_subpaths(const LightSubpaths& subpaths, const SceneInfo& scene, Order order, OrderedVertices& result) {
  order_by(subpaths, scene, order, result);
}

}  // namespace bdpt
