// Round curves, such as hair: strands of segments, each a circle of varying radius swept along its axis. A linear
// segment is the cone that touches the spheres round its two control points; the spheres close strands at their ends.
//
// The ray queries are exact to some ulps of 1, whatever the scale, and of a segment's length. So coordinates are kept
// in a unit near the mean radius, and long linear segments are cut.
#pragma once

#include "base/memory.h"
#include "math/box.h"
#include "math/transform.h"

#include <cstdint>
#include <string>
#include <vector>

namespace bdpt {

enum class CurveBasis : uint8_t { Linear, Bezier, BSpline, CatmullRom };

struct ControlPoint {
  Vec3 p;
  float radius;
};

struct CurveSegment {
  uint32_t first;    // control point
  float begin, end;  // where on its strand, [0,1]
};

// A place on the surface, in the unit of the curves.
struct CurvePlace {
  Vec3 p;
  Vec3 normal;   // unit, outward
  Vec3 along;    // how the axis moves from a segment's begin to its end
  float margin;  // see off_surface()
};

struct Curves {
  static constexpr float kLongest = 64;  // linear segments are not longer than so many radii

  std::string label;
  CurveBasis basis = CurveBasis::Linear;
  float unit = 1;  // length of one unit of `points`, a power of two
  std::vector<ControlPoint> points;
  std::vector<CurveSegment> segments;
  Box box;               // bounds()
  uint64_t dropped = 0;  // segments without a length or a radius
  uint64_t content_hash = 0;
  Booking booking;

  uint64_t memory() const { return points.size() * sizeof(ControlPoint) + segments.size() * sizeof(CurveSegment); }
  // Texture coordinate u of a place: 0 to 1 along its strand.
  float along(uint32_t segment, float u) const {
    const CurveSegment& s = segments[segment];
    return s.begin + (s.end - s.begin) * u;
  }
  // The point of the surface nearest to one where the ray queries found it, at u of the segment; false where the
  // surface has no normal.
  bool place(uint32_t segment, float u, const Vec3& found, CurvePlace& place) const;
  Box bounds() const;
  // The segment's control points in the Bezier basis: 2 of a linear one, else 4.
  int bezier(uint32_t segment, ControlPoint b[4]) const;
};

// The control points of a cubic segment of any basis in the Bezier basis, in place.
void to_bezier(CurveBasis basis, ControlPoint p[4]);

// A transform after the one from a unit to the length it stands for.
Transform in_unit(const Transform& transform, float unit);

}  // namespace bdpt
