#include "api/subdivision_data.h"

#include "api/check.h"
#include "api/desc.h"
#include "api/host_view.h"
#include "api/mesh_data.h"
#include "geometry/margin.h"
#include "geometry/subdivision.h"

#include <algorithm>
#include <set>

namespace bdpt {
namespace {

constexpr float kMostReach = 1e16f;  // Embree aborts above 1.8e18, in what it sums, too

template <class T>
std::vector<T> copy(const HostView& view, size_t padding = 0) {
  std::vector<T> values;
  values.reserve(view.count + padding);
  const View<T> from = view.as<T>();
  for (size_t i = 0; i < from.size(); ++i) values.push_back(from[i]);
  values.resize(view.count + padding, T(0));
  return values;
}

class CageReader {
 public:
  explicit CageReader(const bdpt_subdivision_desc& desc) : subject_("subdivision surface", desc.label), desc_(desc) {
    subject_.check_reserved("reserved", desc.reserved);
    subject_.check_enum("boundary", desc.boundary, BDPT_BOUNDARY_PIN);
    subject_.check_range("level", desc.level, 1, 64);
    constexpr uint32_t kIndex = format_bit(BDPT_FORMAT_UINT32), kNumber = format_bit(BDPT_FORMAT_FLOAT1);
    positions_ = read_view(subject_, "positions", desc.positions, format_bit(BDPT_FORMAT_FLOAT3));
    face_counts_ = read_view(subject_, "face_counts", desc.face_counts, kIndex);
    indices_ = read_view(subject_, "indices", desc.indices, kIndex);
    uv_ = read_view(subject_, "uv", desc.uv, format_bit(BDPT_FORMAT_FLOAT2));
    uv_indices_ = read_view(subject_, "uv_indices", desc.uv_indices, kIndex);
    crease_edges_ = read_view(subject_, "crease_edges", desc.crease_edges, kIndex);
    crease_weights_ = read_view(subject_, "crease_weights", desc.crease_weights, kNumber);
    corners_ = read_view(subject_, "corners", desc.corners, kIndex);
    corner_weights_ = read_view(subject_, "corner_weights", desc.corner_weights, kNumber);
  }
  const Subject& subject() const { return subject_; }

  // Of the copy, and of the edges found in it.
  uint64_t bytes() const {
    return (positions_.count + 2) * 20 + (face_counts_.count + indices_.count / 3) * 8 + indices_.count * (4 * 4 + 40) +
           uv_.count * 8 + (crease_edges_.count + corners_.count) * 48;
  }

  void read(ControlCage& cage, CageEdges& edges) const {
    check_finite_view(subject_, "positions", positions_);
    check_finite_view(subject_, "uv", uv_);
    cage.positions = copy<Vec3>(positions_, 2);
    for (uint64_t i = 0; i < positions_.count; ++i)
      if (const float reach = largest(cage.positions[i]); reach > kMostReach)
        subject_.refuse("positions", "reaches ", reach, " in element ", i, ": keep the surface within ", kMostReach);
    cage.indices = copy<uint32_t>(indices_);
    cage.counts = face_counts_.count ? copy<uint32_t>(face_counts_) : std::vector<uint32_t>(indices_.count / 4, 4);
    cage.boundary = SubdivisionBoundary(desc_.boundary);
    check_faces(cage);
    read_uv(cage);
    check_edges(cage, edges);
    read_creases(cage, edges);
    read_corners(cage);
  }

 private:
  void check_faces(const ControlCage& cage) const;
  void check_edges(const ControlCage& cage, CageEdges& edges) const;
  void check_indices(const char* field, const HostView& indices, const char* of, uint64_t count) const;
  void check_weights(const char* field, const HostView& weights, uint64_t count) const;
  void read_uv(ControlCage& cage) const;
  void read_creases(ControlCage& cage, const CageEdges& edges) const;
  void read_corners(ControlCage& cage) const;

  Subject subject_;
  const bdpt_subdivision_desc& desc_;
  HostView positions_, face_counts_, indices_, uv_, uv_indices_, crease_edges_, crease_weights_, corners_,
      corner_weights_;
};

void CageReader::check_indices(const char* field, const HostView& indices, const char* of, uint64_t count) const {
  for (uint64_t i = 0; i < indices.count; ++i)
    if (const uint32_t v = indices.as<uint32_t>()[i]; v >= count)
      subject_.refuse(field, "has index ", v, " in element ", i, ": give indices below the count of ", of, " (", count,
                      ")");
}

void CageReader::check_faces(const ControlCage& cage) const {
  if (cage.counts.empty())
    subject_.refuse("indices.count", "is ", indices_.count,
                    ": give at least one face, of 4 indices without face_counts");
  if (!face_counts_.count && indices_.count % 4 != 0)
    subject_.refuse("indices.count", "is ", indices_.count, ": without face_counts, give 4 indices for each face");
  check_indices("indices", indices_, "positions", positions_.count);
  uint64_t total = 0;
  for (uint64_t face = 0; face < cage.counts.size(); ++face) {
    const uint32_t n = cage.counts[face];
    if (n < 3 || n > ControlCage::kMostCorners)
      subject_.refuse("face_counts", "is ", n, " in element ", face, ": give faces of 3 to ", ControlCage::kMostCorners,
                      " corners");
    if (n != 4 && desc_.level % 2 != 0)
      subject_.refuse("level", "is ", desc_.level, ", and face ", face, " has ", n,
                      " corners: faces of other than 4 are cut at the middles of their edges; give an even number");
    if (total + n <= indices_.count)
      for (uint32_t i = 0; i < n; ++i)
        for (uint32_t k = 0; k < i; ++k)
          if (cage.indices[total + i] == cage.indices[total + k])
            subject_.refuse("indices", "has index ", cage.indices[total + i], " twice in face ", face,
                            ": give each corner a position of its own");
    total += n;
  }
  if (total != indices_.count)
    subject_.refuse("face_counts", "add up to ", total, ": they must add up to the count of indices (", indices_.count,
                    ")");
}

void CageReader::check_edges(const ControlCage& cage, CageEdges& edges) const {
  const CageFault fault = find_edges(cage, edges);
  if (fault.kind == CageFault::Kind::Edge)
    subject_.refuse("indices", "make faces ", fault.faces[0], " and ", fault.faces[1], " go along the edge from ",
                    fault.position, " to ", fault.other,
                    " in the same direction: turn one round, and let at most two faces share an edge");
  if (fault.kind == CageFault::Kind::Position)
    subject_.refuse("indices", "make faces meet at position ", fault.position,
                    " that share no edge there: give each group of faces a position of its own");
  std::vector<uint32_t> faces(positions_.count), neighbours(positions_.count);
  for (uint32_t c = 0; c < cage.indices.size(); ++c) {
    const uint32_t v = cage.indices[c];
    ++faces[v];
    neighbours[v] += cage.counts[edges.face[c]] - 2;
    if (faces[v] > ControlCage::kMostFaces || neighbours[v] > ControlCage::kMostNeighbours)
      subject_.refuse("indices", "make too many faces meet at position ", v, ": at most ", ControlCage::kMostFaces,
                      " may, with at most ", ControlCage::kMostNeighbours, " corners beside them");
  }
}

void CageReader::read_uv(ControlCage& cage) const {
  if (uv_.count == 0) {
    if (uv_indices_.count) subject_.refuse("uv_indices", "is given without uv: give both, or neither");
    return;
  }
  const uint64_t expected = uv_indices_.count ? indices_.count : positions_.count;
  if (uv_indices_.count && uv_indices_.count != expected)
    subject_.refuse("uv_indices.count", "is ", uv_indices_.count, ": give as many as indices (", expected,
                    "), or none");
  if (!uv_indices_.count && uv_.count != expected)
    subject_.refuse("uv.count", "is ", uv_.count, ": without uv_indices, give as many as positions (", expected, ")");
  check_indices("uv_indices", uv_indices_, "uv", uv_.count);
  cage.uv = copy<Vec2>(uv_);
  cage.uv_indices = uv_indices_.count ? copy<uint32_t>(uv_indices_) : cage.indices;
}

void CageReader::check_weights(const char* field, const HostView& weights, uint64_t count) const {
  if (weights.count != count)
    subject_.refuse((std::string(field) + ".count").c_str(), "is ", weights.count, ": give one for each (", count, ")");
  for (uint64_t i = 0; i < weights.count; ++i)
    if (const float w = weights.as<float>()[i]; !(w >= 0))
      subject_.refuse(field, "is ", w, " in element ", i, ": give 0 or more; infinity is sharp");
}

void CageReader::read_creases(ControlCage& cage, const CageEdges& edges) const {
  if (crease_edges_.count % 2 != 0)
    subject_.refuse("crease_edges.count", "is ", crease_edges_.count, ": give two positions for each edge");
  check_indices("crease_edges", crease_edges_, "positions", positions_.count);
  check_weights("crease_weights", crease_weights_, crease_edges_.count / 2);
  cage.crease_edges = copy<uint32_t>(crease_edges_);
  cage.crease_weights = copy<float>(crease_weights_);
  if (cage.crease_edges.empty()) return;
  std::set<std::pair<uint32_t, uint32_t>> known, seen;
  for (uint32_t c = 0; c < cage.indices.size(); ++c)
    known.insert(std::minmax({cage.indices[c], cage.indices[edges.next(c)]}));
  for (size_t i = 0; i < cage.crease_edges.size(); i += 2) {
    const std::pair<uint32_t, uint32_t> edge = std::minmax({cage.crease_edges[i], cage.crease_edges[i + 1]});
    if (!known.count(edge))
      subject_.refuse("crease_edges", "name ", edge.first, " and ", edge.second, " in crease ", i / 2,
                      ", which no face has as an edge: name edges of faces");
    if (!seen.insert(edge).second)
      subject_.refuse("crease_edges", "name ", edge.first, " and ", edge.second, " again in crease ", i / 2,
                      ": name each edge once");
  }
}

void CageReader::read_corners(ControlCage& cage) const {
  check_indices("corners", corners_, "positions", positions_.count);
  check_weights("corner_weights", corner_weights_, corners_.count);
  cage.corners = copy<uint32_t>(corners_);
  cage.corner_weights = copy<float>(corner_weights_);
  std::set<uint32_t> seen;
  for (uint32_t v : cage.corners)
    if (!seen.insert(v).second) subject_.refuse("corners", "name position ", v, " again: name each once");
}

// The host's callback, and what it gives.
Displace displacement(const bdpt_subdivision_desc& desc, const Subject& subject, HostCalls& calls) {
  if (!desc.displace) return {};
  return [&](size_t count, const Vec3* positions, const Vec3* normals, const Vec2* uv, Vec3* displaced) {
    calls.run("desc.displace",
              [&] { return desc.displace(desc.user, count, &positions->x, &normals->x, &uv->x, &displaced->x); });
    calls.check();
    for (size_t i = 0; i < count; ++i)
      if (const Vec3& p = displaced[i]; !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)))
        fail(ErrorCode::CallbackFailed, "displace of ", subject.name(), " moves (", positions[i].x, ", ",
             positions[i].y, ", ", positions[i].z, ") to (", p.x, ", ", p.y, ", ", p.z, "): give finite numbers");
  };
}

template <class T>
bdpt_data packed(const std::vector<T>& values, bdpt_format format) {
  bdpt_data d{};
  d.data = values.data(), d.count = values.size(), d.format = format;
  return d;
}

}  // namespace

std::shared_ptr<const Mesh> read_subdivision(const bdpt_subdivision_desc& desc, const RayDevice& device,
                                             const std::shared_ptr<MemoryMeter>& meter) {
  const CageReader reader(desc);
  const Subject& subject = reader.subject();
  const Booking cage_booking(meter, reader.bytes(), subject.name().c_str());
  ControlCage cage;
  CageEdges edges;
  reader.read(cage, edges);
  const DiceSize size = size_of_dice(cage, edges, desc.level);
  if (!size.fits)
    subject.refuse("level", "is ", desc.level, ", which makes ", size.triangles,
                   " triangles: give a smaller one, or fewer faces");
  const Booking booking(meter, size.bytes, ("the triangles of " + subject.name()).c_str());
  HostCalls calls;
  const Diced diced = dice(cage, edges, desc.level, device, displacement(desc, subject, calls));

  bdpt_mesh_desc mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.label = desc.label;
  mesh.positions = packed(diced.positions, BDPT_FORMAT_FLOAT3);
  mesh.normals = packed(diced.normals, BDPT_FORMAT_FLOAT3);
  mesh.indices = packed(diced.triangles, BDPT_FORMAT_UINT32X3);
  mesh.uv[0] = packed(diced.uv, BDPT_FORMAT_FLOAT2);
  MeshReleases releases(&mesh);
  return read_mesh(mesh, releases, meter);
}

}  // namespace bdpt
