#include "lightmap/overlap.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bdpt {
namespace {

constexpr double kLeastShare = 1e-3;

struct UvBox {
  Vec2d low, high;
};

UvBox box_of(const UvTriangle& t) {
  UvBox box{t[0], t[0]};
  for (const Vec2d& p : t)
    for (int axis = 0; axis < 2; ++axis) {
      box.low[axis] = std::min(box.low[axis], p[axis]);
      box.high[axis] = std::max(box.high[axis], p[axis]);
    }
  return box;
}

// The part of a polygon to the left of the line from a to b (x towards y), into result.
void clip_to_left(const std::vector<Vec2d>& polygon, const Vec2d& a, const Vec2d& b, std::vector<Vec2d>& result) {
  result.clear();
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec2d &p = polygon[i], &next = polygon[(i + 1) % polygon.size()];
    const double here = signed_double_area(a, b, p), there = signed_double_area(a, b, next);
    if (here >= 0) result.push_back(p);
    if ((here > 0 && there < 0) || (here < 0 && there > 0)) result.push_back(p + (next - p) * (here / (here - there)));
  }
}

double area_of(const std::vector<Vec2d>& polygon) {
  double twice = 0;
  for (size_t i = 2; i < polygon.size(); ++i) twice += signed_double_area(polygon[0], polygon[i - 1], polygon[i]);
  return 0.5 * std::fabs(twice);
}

// Which pairs of boxes meet. The plane is cut into strips; within each, a sweep along x. A pair is looked at in the
// strip where the later of the two begins.
class Sweep {
 public:
  Sweep(const std::vector<UvTriangle>& triangles, double height) : height_(height) {
    boxes_.reserve(triangles.size());
    for (const UvTriangle& t : triangles) boxes_.push_back(box_of(t));
    choose_strips();
    fill_strips();
  }

  // visit(a, b) until it returns false.
  template <class Visit>
  void run(Visit&& visit) const {
    for (size_t s = 0; s < strips_; ++s)
      for (size_t i = begin_[s]; i < begin_[s + 1]; ++i)
        for (size_t j = i + 1; j < begin_[s + 1]; ++j) {
          const UvBox &a = boxes_[members_[i]], &b = boxes_[members_[j]];
          if (b.low.x >= a.high.x) break;
          if (b.low.y >= a.high.y || a.low.y >= b.high.y || strip(std::max(a.low.y, b.low.y)) != s) continue;
          if (!visit(std::min(members_[i], members_[j]), std::max(members_[i], members_[j]))) return;
        }
  }

 private:
  size_t strip(double y) const {
    return size_t(std::clamp(std::floor(y / height_ * double(strips_)), 0.0, double(strips_ - 1)));
  }
  size_t places() const {
    size_t n = 0;
    for (const UvBox& box : boxes_) n += strip(box.high.y) - strip(box.low.y) + 1;
    return n;
  }
  void choose_strips() {
    constexpr size_t kMostPlaces = 4;  // of a triangle, on average
    strips_ = std::max<size_t>(1, size_t(std::sqrt(double(boxes_.size()))));
    while (strips_ > 1 && places() > kMostPlaces * boxes_.size()) strips_ /= 2;
  }
  void fill_strips() {
    std::vector<size_t> order(boxes_.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
      return boxes_[a].low.x != boxes_[b].low.x ? boxes_[a].low.x < boxes_[b].low.x : a < b;
    });
    begin_.assign(strips_ + 1, 0);
    for (const UvBox& box : boxes_)
      for (size_t s = strip(box.low.y); s <= strip(box.high.y); ++s) ++begin_[s + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    members_.resize(begin_.back());
    std::vector<size_t> end(begin_.begin(), begin_.end() - 1);
    for (const size_t i : order)
      for (size_t s = strip(boxes_[i].low.y); s <= strip(boxes_[i].high.y); ++s) members_[end[s]++] = i;
  }

  double height_;
  std::vector<UvBox> boxes_;
  size_t strips_ = 1;
  std::vector<size_t> begin_, members_;  // members of strip s: begin_[s] to begin_[s + 1], by their least x
};

}  // namespace

void for_each_overlap(const std::vector<UvTriangle>& triangles, double height,
                      const std::function<bool(const UvOverlap&)>& visit) {
  UvOverlap overlap;
  std::vector<Vec2d> scratch;
  Sweep(triangles, height).run([&](size_t a, size_t b) {
    const UvTriangle &first = triangles[a], &second = triangles[b];
    overlap.corners.assign(first.begin(), first.end());
    const bool left = signed_double_area(second[0], second[1], second[2]) > 0;
    for (int i = 0; i < 3 && !overlap.corners.empty(); ++i) {
      const Vec2d &p = second[size_t(i)], &q = second[size_t((i + 1) % 3)];
      clip_to_left(overlap.corners, left ? p : q, left ? q : p, scratch);
      overlap.corners.swap(scratch);
    }
    overlap.a = a, overlap.b = b;
    overlap.area = area_of(overlap.corners);
    const double least = std::max(kLeastOverlap, kLeastShare * std::min(area(first), area(second)));
    return !(overlap.area > least) || visit(overlap);
  });
}

}  // namespace bdpt
