#include "light/light_tree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

namespace bdpt {

namespace {

constexpr double kHalfPi = 1.57079632679489662, kAllAround = 2 * kHalfPi;
constexpr int kBuckets = 12;
// Splits by cost down to here, by halves below: no way is longer than 64 bits.
constexpr int kMaxDepthByCost = 15;
constexpr float kLeastDistance = 1e-6f;  // relative to the tree's size

using Vec3d = Imath::V3d;

// Directions within `angle` of the axis; two_sided: or of its opposite.
struct Cone {
  Vec3d axis{0, 0, 1};
  double angle = -1;  // nothing
  double falloff = 0;
  bool two_sided = false;
};

double angle_between(const Vec3d& a, const Vec3d& b) { return std::atan2(a.cross(b).length(), a.dot(b)); }

// The least cone round both, or a little more.
Cone unite(const Cone& a, const Cone& b) {
  if (a.angle < 0) return b;
  if (b.angle < 0) return a;
  const Cone& wide = a.angle >= b.angle ? a : b;
  const Cone& narrow = a.angle >= b.angle ? b : a;
  Cone c = wide;
  c.falloff = std::max(a.falloff, b.falloff);
  c.two_sided = a.two_sided || b.two_sided;
  if (wide.angle >= kAllAround) return c;
  constexpr double slack = 1e-6;  // axes are rounded
  const double between = angle_between(wide.axis, narrow.axis);
  if (between + narrow.angle <= wide.angle) return c;
  c.angle = 0.5 * (wide.angle + between + narrow.angle) + slack;
  const Vec3d across = wide.axis.cross(narrow.axis);
  if (c.angle >= kAllAround || !(across.length() > 0)) {
    if (between > kHalfPi || c.angle >= kAllAround) c.angle = kAllAround;
    return c;
  }
  // The axis turned from the wide one toward the narrow one.
  const double turn = c.angle - wide.angle;
  const Vec3d side = across.normalized().cross(wide.axis);
  c.axis = (wide.axis * std::cos(turn) + side * std::sin(turn)).normalized();
  return c;
}

struct Bounds {
  Vec3d low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  Cone cone;
  double intensity = 0;

  Vec3d diagonal() const { return high - low; }
  Vec3d center() const { return (low + high) * 0.5; }
  void add(const Bounds& o) {
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], o.low[i]), high[i] = std::max(high[i], o.high[i]);
    cone = unite(cone, o.cone);
    intensity += o.intensity;
  }
  // What it costs to have these in one node: the paper's equation 2, a surface area times a solid angle.
  double cost() const {
    if (cone.angle < 0) return 0;
    const Vec3d d = diagonal();
    const double surface = d.x * d.y + d.y * d.z + d.z * d.x + 1e-3 * d.length2();  // a line has no area
    const double o = cone.angle, w = std::min(o + cone.falloff, kAllAround);
    const double solid_angle = 4 * kHalfPi * (1 - std::cos(o)) + kHalfPi * (2 * w * std::sin(o) - std::cos(o - 2 * w) -
                                                                            2 * o * std::sin(o) + std::cos(o));
    return intensity * surface * solid_angle;
  }
};

Bounds bounds_of(const Emitter& e, double scale) {
  Bounds b;
  b.low = Vec3d(e.low), b.high = Vec3d(e.high);
  b.cone = {Vec3d(e.axis), std::acos(std::clamp(e.cos_o, -1.0, 1.0)), std::acos(std::clamp(e.cos_e, -1.0, 1.0)),
            e.two_sided};
  b.intensity = e.intensity * scale;
  return b;
}

}  // namespace

class LightTree::Build {
 public:
  Build(LightTree& tree, const std::vector<Emitter>& emitters) : tree_(tree), emitters_(emitters) {
    double most = 0;
    for (const Emitter& e : emitters) most = std::max(most, e.intensity);
    for (size_t i = 0; i < emitters.size(); ++i)
      if (emitters[i].intensity > 0) items_.push_back({bounds_of(emitters[i], 1 / most), uint32_t(i)});
    tree_.ways_.assign(emitters.size(), kNoWay);
    if (items_.empty()) return;
    const Range all = range(0, items_.size());
    const float size = float(all.bounds.diagonal().length()) * kLeastDistance;
    tree_.floor_ = std::max(size * size, 1e-30f);
    make_node(all, 0, 0);
    tree_.nodes_.shrink_to_fit();
  }

 private:
  struct Item {
    Bounds bounds;
    uint32_t emitter;
  };
  struct Range {
    size_t begin = 0, end = 0;
    Bounds bounds;
    size_t size() const { return end - begin; }
  };

  Range range(size_t begin, size_t end) const {
    Range r{begin, end, {}};
    for (size_t i = begin; i < end; ++i) r.bounds.add(items_[i].bounds);
    return r;
  }

  // A node of up to four children: the largest part is split until there are four. way: to this node.
  int32_t make_node(const Range& whole, uint64_t way, int depth) {
    std::array<Range, kWidth> part{whole};
    int parts = 1;
    while (parts < kWidth) {
      const auto end = part.begin() + parts;
      const auto largest =
          std::max_element(part.begin(), end, [](const Range& a, const Range& b) { return a.size() < b.size(); });
      if (largest->size() < 2) break;
      std::tie(*largest, part[size_t(parts)]) = split(*largest, depth);
      ++parts;
    }
    const size_t index = tree_.nodes_.size();
    tree_.nodes_.emplace_back();
    for (int k = 0; k < parts; ++k) {
      const Range& p = part[size_t(k)];
      const uint64_t way_there = way | uint64_t(k) << (2 * depth);
      fill(tree_.nodes_[index], k, p.bounds);
      int32_t child;
      if (p.size() == 1) {
        const uint32_t emitter = items_[p.begin].emitter;
        tree_.ways_[emitter] = way_there;
        tree_.nodes_[index].triangle[k] = emitters_[emitter].triangle;
        child = ~int32_t(emitters_[emitter].light);
      } else {
        child = make_node(p, way_there, depth + 1);
      }
      tree_.nodes_[index].child[k] = child;
    }
    return int32_t(index);
  }

  static void fill(Node& node, int k, const Bounds& b) {
    const Vec3d center = b.center();
    for (int i = 0; i < 3; ++i) node.center[i][k] = float(center[i]), node.axis[i][k] = float(b.cone.axis[i]);
    const double radius = 0.5 * b.diagonal().length();
    if (radius > 0) node.radius[k] = float((radius + center.length() * 1e-7) * (1 + 1e-6));  // center is rounded
    node.cos_o[k] = b.cone.angle >= kAllAround ? -1 : float(std::cos(b.cone.angle));
    node.sin_o[k] = b.cone.angle >= kAllAround ? 0 : float(std::sin(b.cone.angle));
    node.cos_e[k] = b.cone.falloff == kHalfPi ? 0 : float(std::cos(b.cone.falloff));
    node.two_sided[k] = b.cone.two_sided;
    node.intensity[k] = std::max(float(b.intensity), std::numeric_limits<float>::min());
  }

  // In two that both hold something, where the range has two or more.
  std::pair<Range, Range> split(const Range& whole, int depth) {
    const auto first = items_.begin() + ptrdiff_t(whole.begin), last = items_.begin() + ptrdiff_t(whole.end);
    Vec3d low(std::numeric_limits<double>::infinity()), high(-low);
    for (auto i = first; i != last; ++i)
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], i->bounds.center()[k]);
        high[k] = std::max(high[k], i->bounds.center()[k]);
      }
    double best = std::numeric_limits<double>::infinity();
    int axis = -1, border = 0;
    const double longest = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    const auto bucket = [&](const Item& item, int k) {
      return std::min(int(kBuckets * (item.bounds.center()[k] - low[k]) / (high[k] - low[k])), kBuckets - 1);
    };
    for (int k = 0; k < 3 && depth < kMaxDepthByCost; ++k) {
      if (!(high[k] > low[k])) continue;
      std::array<Bounds, kBuckets> buckets;
      for (auto i = first; i != last; ++i) buckets[size_t(bucket(*i, k))].add(i->bounds);
      std::array<double, kBuckets> above{};  // cost of the buckets from here on
      Bounds sum;
      for (int b = kBuckets - 1; b > 0; --b) sum.add(buckets[size_t(b)]), above[size_t(b)] = sum.cost();
      sum = Bounds();
      const double thin = longest / (high[k] - low[k]);  // the paper's k_r
      for (int b = 1; b < kBuckets; ++b) {
        sum.add(buckets[size_t(b - 1)]);
        const double cost = thin * (sum.cost() + above[size_t(b)]);
        if (cost < best) best = cost, axis = k, border = b;
      }
    }
    auto middle = first + (last - first) / 2;
    if (axis >= 0) {
      middle = std::partition(first, last, [&](const Item& i) { return bucket(i, axis) < border; });
      if (middle == first || middle == last) middle = first + (last - first) / 2;
    }
    const size_t at = size_t(middle - items_.begin());
    return {range(whole.begin, at), range(at, whole.end)};
  }

  LightTree& tree_;
  const std::vector<Emitter>& emitters_;
  std::vector<Item> items_;
};

LightTree::LightTree(const std::vector<Emitter>& emitters) { Build(*this, emitters); }

namespace {

// Four children's numbers in one register. (The compilers' own vectors: as loops these would not be vectorised.)
using Four = LightTree::Four;

inline Four most(Four a, Four b) { return a > b ? a : b; }
inline Four root(Four x) {
  x = most(x, Four{});
  for (int i = 0; i < 4; ++i) x[i] = std::sqrt(x[i]);
  return x;
}
inline float sum(Four x) { return (x[0] + x[1]) + (x[2] + x[3]); }

// Cosine and sine of the angle a - b, or of 0 where b is larger; a and b in [0, pi].
inline Four cos_less(Four cos_a, Four sin_a, Four cos_b, Four sin_b) {
  return cos_a > cos_b ? Four{} + 1 : cos_a * cos_b + sin_a * sin_b;
}
inline Four sin_less(Four cos_a, Four sin_a, Four cos_b, Four sin_b) {
  return cos_a > cos_b ? Four{} : sin_a * cos_b - cos_a * sin_b;
}

}  // namespace

// One code for choosing and for telling the probability, never inlined: the two must agree to the bit.
[[gnu::noinline]] LightTree::Four LightTree::shares(const Node& node, const Receiver& x) const {
  const Four dx = node.center[0] - x.p.x, dy = node.center[1] - x.p.y, dz = node.center[2] - x.p.z;
  const Four d2 = dx * dx + dy * dy + dz * dz, r2 = node.radius * node.radius;
  const Four far2 = most(d2, most(r2, Four{} + floor_)), inverse = 1 / root(far2);
  // The angle under which the bounds appear; x within them sees them all around.
  const Four sin_b = node.radius * inverse, cos_b = root(1 - sin_b * sin_b);
  // From the axis to x, less the cone's width, less the bounds'.
  const Four toward = -(node.axis[0] * dx + node.axis[1] * dy + node.axis[2] * dz) * inverse;
  const Four cos_w = most(toward, -toward * node.two_sided - (1 - node.two_sided));
  const Four sin_w = root(1 - cos_w * cos_w);
  const Four cos_x = cos_less(cos_w, sin_w, node.cos_o, node.sin_o);
  const Four sin_x = sin_less(cos_w, sin_w, node.cos_o, node.sin_o);
  const Four cos_y = cos_less(cos_x, sin_x, cos_b, sin_b);
  Four importance = node.intensity / far2;
  importance *= d2 <= r2 ? Four{} + 1 : cos_y >= node.cos_e ? cos_y : Four{};
  if (x.normal.x != 0 || x.normal.y != 0 || x.normal.z != 0) {
    // From the receiver's normal, less the bounds' width.
    const Four along = (x.normal.x * dx + x.normal.y * dy + x.normal.z * dz) * inverse;
    const Four cos_i = most(along, -along);
    importance *= d2 <= r2 ? Four{} + 1 : cos_less(cos_i, root(1 - cos_i * cos_i), cos_b, sin_b);
  }
  const float total = sum(importance);
  // Nothing of it reaches x, as it seems: by intensity.
  return total > 0 ? importance / total : node.intensity / sum(node.intensity);
}

LightTree::Choice LightTree::sample(const Receiver& x, double u) const {
  float probability = 1;
  for (int32_t n = 0;;) {
    const Node& node = nodes_[size_t(n)];
    const Four share = shares(node, x);
    // Share k takes [end[k - 1], end[k]) of u. Without branches, which nobody could foresee.
    const double end[] = {share[0], double(share[0]) + share[1], double(share[0]) + share[1] + share[2]};
    int k = (u >= end[0]) + (u >= end[1]) + (u >= end[2]);
    while (!(share[k] > 0)) --k;  // past the end, by rounding
    const double begin = k > 0 ? end[k - 1] : 0;
    u = std::clamp((u - begin) / double(share[k]), 0.0, 0x1.fffffffffffffp-1);
    probability *= share[k];
    n = node.child[k];
    if (n < 0) return {uint32_t(~n), node.triangle[k], probability, u};
  }
}

float LightTree::probability(uint32_t emitter, const Receiver& x) const {
  uint64_t way = ways_[emitter];
  if (way == kNoWay) return 0;
  float probability = 1;
  for (int32_t n = 0;; way >>= 2) {
    const Node& node = nodes_[size_t(n)];
    const Four share = shares(node, x);
    probability *= share[int(way & 3)];
    n = node.child[way & 3];
    if (n < 0) return probability;
  }
}

}  // namespace bdpt
