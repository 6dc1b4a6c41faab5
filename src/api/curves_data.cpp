#include "api/curves_data.h"

#include "api/check.h"
#include "api/desc.h"
#include "api/host_view.h"
#include "sampling/hash.h"

namespace bdpt {
namespace {

// Control points of a strand's first segment, and more for each further one.
struct Pieces {
  uint64_t first, further;
};
constexpr Pieces kPieces[] = {{2, 1}, {4, 3}, {4, 1}, {4, 1}};

class CurvesReader {
 public:
  CurvesReader(const bdpt_curves_desc& desc, const std::shared_ptr<MemoryMeter>& meter)
      : subject_("curves", desc.label), meter_(meter) {
    subject_.check_enum("basis", desc.basis, BDPT_CURVE_CATMULL_ROM);
    curves_->basis = CurveBasis(desc.basis);
    positions_ = read_view(subject_, "positions", desc.positions, format_bit(BDPT_FORMAT_FLOAT3));
    radii_ = read_view(subject_, "radii", desc.radii, format_bit(BDPT_FORMAT_FLOAT1));
    counts_ = read_view(subject_, "counts", desc.counts, format_bit(BDPT_FORMAT_UINT32));
  }

  std::shared_ptr<const Curves> read() {
    check_values();
    check_counts();
    choose_unit();
    Tally tally;
    walk(tally);
    if (tally.segments == 0)
      subject_.refuse("positions", "make ", tally.dropped,
                      " segments, none of which has a length and a radius: give at least one that has");
    if (tally.points > 0xFFFFFFFEu || tally.segments > 0xFFFFFFFEu)
      subject_.refuse("positions", "make ", tally.segments, " segments, linear ones being cut to ", Curves::kLongest,
                      " radii: give fewer, or larger radii");
    Curves& c = *curves_;
    c.booking = Booking(meter_, tally.points * sizeof(ControlPoint) + tally.segments * sizeof(CurveSegment),
                        subject_.name().c_str());
    c.points.reserve(tally.points);
    c.segments.reserve(tally.segments);
    Filler filler{c};
    walk(filler);
    check_radii();
    c.box = c.bounds();
    c.label = subject_.label();
    c.dropped = tally.dropped;
    c.content_hash = hash_bytes(c.points.data(), c.points.size() * sizeof(ControlPoint), hash_values(int(c.basis)));
    c.content_hash = hash_bytes(c.segments.data(), c.segments.size() * sizeof(CurveSegment), c.content_hash);
    c.content_hash = hash_bytes(&c.unit, sizeof c.unit, c.content_hash);
    return curves_;
  }

 private:
  struct Tally {
    uint64_t points = 0, segments = 0, dropped = 0;
    void point(const ControlPoint&) { ++points; }
    void segment(uint64_t, float, float) { ++segments; }
    void drop() { ++dropped; }
  };
  struct Filler {
    Curves& curves;
    void point(const ControlPoint& p) { curves.points.push_back(p); }
    void segment(uint64_t first, float begin, float end) { curves.segments.push_back({uint32_t(first), begin, end}); }
    void drop() {}
  };

  uint64_t strand_count() const { return counts_.count ? counts_.count : 1; }
  uint64_t count(uint64_t strand) const { return counts_.count ? counts_.as<uint32_t>()[strand] : positions_.count; }
  float radius(uint64_t i) const { return radii_.as<float>()[radii_.count == 1 ? 0 : i]; }
  ControlPoint point(uint64_t i) const {
    return {positions_.as<Vec3>()[i] * (1 / curves_->unit), radius(i) * (1 / curves_->unit)};
  }

  void check_values() const;
  void check_counts() const;
  void check_radii() const;
  void choose_unit();
  // Tells the sink of all points and segments that are kept, in order.
  template <class Sink>
  void walk(Sink& sink) const;
  template <class Sink>
  void walk_linear(uint64_t first, uint64_t n, uint64_t& next, Sink& sink) const;
  template <class Sink>
  void walk_cubic(uint64_t first, uint64_t n, uint64_t& next, Sink& sink) const;

  Subject subject_;
  const std::shared_ptr<MemoryMeter>& meter_;
  HostView positions_, radii_, counts_;
  std::shared_ptr<Curves> curves_ = std::make_shared<Curves>();
};

void CurvesReader::check_values() const {
  check_finite_view(subject_, "positions", positions_);
  check_finite_view(subject_, "radii", radii_);
  if (radii_.count != positions_.count && radii_.count != 1)
    subject_.refuse("radii.count", "is ", radii_.count, ": give as many as positions (", positions_.count,
                    "), or one for all");
  for (uint64_t i = 0; i < radii_.count; ++i)
    if (const float r = radii_.as<float>()[i]; !(r >= 0))
      subject_.refuse("radii", "is ", r, " in element ", i, ": give radii of 0 or more");
}

void CurvesReader::check_counts() const {
  const Pieces pieces = kPieces[int(curves_->basis)];
  uint64_t total = 0;
  for (uint64_t strand = 0; strand < strand_count(); ++strand) {
    const uint64_t n = count(strand);
    if (n < pieces.first || (n - pieces.first) % pieces.further != 0)
      subject_.refuse(counts_.count ? "counts" : "positions.count", "is ", n,
                      counts_.count ? " in element " + std::to_string(strand) : std::string(), ": a strand of basis ",
                      int(curves_->basis), " has ", pieces.first, " control points, and ", pieces.further,
                      " more for each further segment");
    total += n;
  }
  if (total != positions_.count)
    subject_.refuse("counts", "add up to ", total, ": they must add up to the count of positions (", positions_.count,
                    ")");
}

// Splines that go through their points may swing below them.
void CurvesReader::check_radii() const {
  if (curves_->basis != CurveBasis::CatmullRom) return;
  for (uint32_t i = 0; i < curves_->segments.size(); ++i) {
    ControlPoint b[4];
    curves_->bezier(i, b);
    const double r0 = b[0].radius, r1 = b[1].radius, r2 = b[2].radius, r3 = b[3].radius;
    const auto at = [&](double u) {
      const double v = 1 - u;
      return v * v * v * r0 + 3 * v * v * u * r1 + 3 * v * u * u * r2 + u * u * u * r3;
    };
    // Where the derivative a u² + 2 b u + c is zero.
    const double qa = r3 - 3 * r2 + 3 * r1 - r0, qb = r0 - 2 * r1 + r2, qc = r1 - r0, root = qb * qb - qa * qc;
    if (!(root > 0)) continue;
    const double s = std::sqrt(root), q = -(qb + std::copysign(s, qb));
    for (const double u : {q / qa, qc / q})
      if (u > 0 && u < 1 && at(u) < -1e-6 * std::max(r0, r3))
        subject_.refuse("radii", "make a spline that is ", at(u) * curves_->unit, " in its segment ", i,
                        ": let them change less, so that it stays above 0");
  }
}

void CurvesReader::choose_unit() {
  double sum = 0, largest = 0;
  for (uint64_t i = 0; i < radii_.count; ++i) sum += radii_.as<float>()[i];
  const View<Vec3> positions = positions_.as<Vec3>();
  for (uint64_t i = 0; i < positions.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::fabs(double(positions[i][axis])));
  const double mean = sum / double(radii_.count);
  if (!(mean > 0)) return;
  // Radii that vanish in the rounding of the coordinates: no unit helps, and none may make these too large.
  constexpr double kMostUnits = 0x1p40;
  int exponent = 0;
  std::frexp(std::max(mean, largest / kMostUnits), &exponent);
  curves_->unit = std::ldexp(1.0f, std::clamp(exponent - 1, -100, 100));
}

template <class Sink>
void CurvesReader::walk(Sink& sink) const {
  uint64_t first = 0, next = 0;
  for (uint64_t strand = 0; strand < strand_count(); ++strand) {
    const uint64_t n = count(strand);
    if (curves_->basis == CurveBasis::Linear)
      walk_linear(first, n, next, sink);
    else
      walk_cubic(first, n, next, sink);
    first += n;
  }
}

// Points that lie together are one, of the largest radius. Long cones are cut into shorter ones, which are the same.
template <class Sink>
void CurvesReader::walk_linear(uint64_t first, uint64_t n, uint64_t& next, Sink& sink) const {
  const auto run = [&](uint64_t& i) {
    ControlPoint p = point(first + i);
    for (; i + 1 < n && point(first + i + 1).p == p.p; ++i) {
      p.radius = std::max(p.radius, point(first + i + 1).radius);
      sink.drop();
    }
    return p;
  };
  const auto part = [&](double i) { return float(i / double(n - 1)); };
  uint64_t i = 0;
  ControlPoint a = run(i);
  bool is_first = true;
  while (i + 1 < n) {
    const uint64_t from = i++;
    const uint64_t to = i;
    const ControlPoint b = run(i);
    if (is_first) sink.point(a), ++next;
    is_first = false;
    const float radius = std::max(a.radius, b.radius);
    const double length = Imath::V3d(Imath::V3d(b.p) - Imath::V3d(a.p)).length();
    const uint64_t pieces =
        radius > 0 ? uint64_t(std::clamp(std::ceil(length / (Curves::kLongest * double(radius))), 1.0, 4294967296.0))
                   : 1;
    if (!(radius > 0)) sink.drop();
    for (uint64_t k = 1; k <= pieces; ++k) {
      const double u = double(k) / double(pieces), before = double(k - 1) / double(pieces);
      const float w = float(u);
      sink.point(k == pieces ? b : ControlPoint{a.p * (1 - w) + b.p * w, a.radius * (1 - w) + b.radius * w});
      const auto place = [&](double v) { return part(double(from) + double(to - from) * v); };
      if (radius > 0) sink.segment(next - 1, place(before), place(u));
      ++next;
    }
    a = b;
  }
}

template <class Sink>
void CurvesReader::walk_cubic(uint64_t first, uint64_t n, uint64_t& next, Sink& sink) const {
  const Pieces pieces = kPieces[int(curves_->basis)];
  const uint64_t segments = (n - pieces.first) / pieces.further + 1;
  for (uint64_t i = 0; i < segments; ++i) {
    const uint64_t at = i * pieces.further;
    const ControlPoint p[] = {point(first + at), point(first + at + 1), point(first + at + 2), point(first + at + 3)};
    const bool has_length = p[1].p != p[0].p || p[2].p != p[0].p || p[3].p != p[0].p;
    const bool has_radius = p[0].radius > 0 || p[1].radius > 0 || p[2].radius > 0 || p[3].radius > 0;
    if (has_length && has_radius)
      sink.segment(next + at, float(double(i) / double(segments)), float(double(i + 1) / double(segments)));
    else
      sink.drop();
  }
  for (uint64_t i = 0; i < n; ++i) sink.point(point(first + i));
  next += n;
}

}  // namespace

std::shared_ptr<const Curves> read_curves(const bdpt_curves_desc& desc, const std::shared_ptr<MemoryMeter>& meter) {
  return CurvesReader(desc, meter).read();
}

}  // namespace bdpt
