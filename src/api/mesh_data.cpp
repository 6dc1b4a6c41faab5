#include "api/mesh_data.h"

#include "api/check.h"
#include "api/desc.h"
#include "api/host_view.h"
#include "api/releases.h"
#include "sampling/hash.h"

namespace bdpt {
namespace {

// The library's own array, with the padding that Embree asks for, and its place in the memory booked.
template <class T>
struct OwnArray {
  Booking booking;
  std::vector<T> values;
};

class MeshReader {
 public:
  MeshReader(const bdpt_mesh_desc& desc, MeshReleases& releases, const std::shared_ptr<MemoryMeter>& meter)
      : subject_("mesh", desc.label), releases_(releases), meter_(meter) {
    subject_.check_reserved("reserved", desc.reserved);
    positions_ = read_view(subject_, "positions", desc.positions, format_bit(BDPT_FORMAT_FLOAT3));
    indices_ = read_view(subject_, "indices", desc.indices,
                         format_bit(BDPT_FORMAT_UINT16X3) | format_bit(BDPT_FORMAT_UINT32X3));
    normals_ = read_view(subject_, "normals", desc.normals, format_bit(BDPT_FORMAT_FLOAT3));
    uv_[0] = read_view(subject_, "uv[0]", desc.uv[0], format_bit(BDPT_FORMAT_FLOAT2));
    uv_[1] = read_view(subject_, "uv[1]", desc.uv[1], format_bit(BDPT_FORMAT_FLOAT2));
    colors_ =
        read_view(subject_, "colors", desc.colors, format_bit(BDPT_FORMAT_FLOAT3) | format_bit(BDPT_FORMAT_FLOAT4));
    tangents_ = read_view(subject_, "tangents", desc.tangents, format_bit(BDPT_FORMAT_FLOAT4));
  }

  std::shared_ptr<const Mesh> read() {
    check_counts();
    check_values();
    mesh_->label = subject_.label();
    mesh_->degenerate = count_degenerate();
    if (mesh_->degenerate == triangle_count())
      subject_.refuse("indices", "make ", triangle_count(),
                      " triangles, none of which has an area: give at least one that has");
    take_positions();
    take_triangles();
    take_normals();
    for (int i = 0; i < 2; ++i) take_uv(i);
    take_colors();
    take_tangents();
    mesh_->content_hash = content_hash();
    return mesh_;
  }

 private:
  void check_counts() const;
  void check_values() const;
  uint64_t triangle_count() const { return indices_.count ? indices_.count : positions_.count / 3; }
  Rgba color(uint64_t i) const;
  Triangle triangle(uint64_t i) const { return read_triangle(indices_, i); }
  bool is_degenerate(const Triangle& t) const {
    const View<Vec3> p = positions_.as<Vec3>();
    return bdpt::is_degenerate(p[t.a], p[t.b], p[t.c]);
  }
  uint64_t count_degenerate() const;

  void take_positions();
  void take_triangles();
  void take_normals();
  void take_uv(int set);
  void take_colors();
  void take_tangents();
  template <class T>
  View<T> borrow(const HostView& view, FinalCall& release);
  template <class T, class Fill>
  View<T> own(uint64_t count, const char* what, Fill&& fill);
  uint64_t content_hash() const;

  Subject subject_;
  MeshReleases& releases_;
  const std::shared_ptr<MemoryMeter>& meter_;
  HostView positions_, indices_, normals_, uv_[2], colors_, tangents_;
  std::shared_ptr<Mesh> mesh_ = std::make_shared<Mesh>();
};

void MeshReader::check_counts() const {
  if (positions_.count < 3)
    subject_.refuse("positions.count", "is ", positions_.count, ": a mesh needs at least one triangle, so 3 positions");
  if (indices_.count == 0 && positions_.count % 3 != 0)
    subject_.refuse("positions.count", "is ", positions_.count,
                    ": without indices, give 3 positions for each triangle");
  const auto check = [&](const char* field, const HostView& view) {
    if (view.count != 0 && view.count != positions_.count)
      subject_.refuse(field, "is ", view.count, ": give as many as positions (", positions_.count, "), or none");
  };
  check("normals.count", normals_);
  check("uv[0].count", uv_[0]);
  check("uv[1].count", uv_[1]);
  check("colors.count", colors_);
  check("tangents.count", tangents_);
}

void MeshReader::check_values() const {
  check_finite_view(subject_, "positions", positions_);
  check_finite_view(subject_, "normals", normals_);
  check_finite_view(subject_, "uv[0]", uv_[0]);
  check_finite_view(subject_, "uv[1]", uv_[1]);
  check_finite_view(subject_, "colors", colors_);
  check_finite_view(subject_, "tangents", tangents_);
  for (uint64_t i = 0; i < colors_.count; ++i)
    for (float v : color(i))
      if (!(v >= 0 && v <= 1)) subject_.refuse("colors", "has the value ", v, " in element ", i, ": give [0,1]");
  for (uint64_t i = 0; i < tangents_.count; ++i) {
    const Tangent t = tangents_.as<Tangent>()[i];
    if (t.direction == Vec3(0) || std::fabs(t.sign) != 1)
      subject_.refuse("tangents", "is (", t.direction.x, ", ", t.direction.y, ", ", t.direction.z, ", ", t.sign,
                      ") in element ", i, ": give a direction of any length but zero, and a sign of 1 or -1");
  }
  const View<Vec3> normals = normals_.as<Vec3>();
  for (size_t i = 0; i < normals.size(); ++i)
    if (normals[i] == Vec3(0))
      subject_.refuse("normals", "has length zero in element ", i, ": give a direction, of any length");
  for (uint64_t i = 0; i < triangle_count(); ++i) {
    const Triangle t = triangle(i);
    const uint32_t largest = std::max(t.a, std::max(t.b, t.c));
    if (largest >= positions_.count)
      subject_.refuse("indices", "has index ", largest, " in triangle ", i,
                      ": give indices below the count of positions (", positions_.count, ")");
  }
}

uint64_t MeshReader::count_degenerate() const {
  uint64_t n = 0;
  for (uint64_t i = 0; i < triangle_count(); ++i) n += is_degenerate(triangle(i));
  return n;
}

template <class T>
View<T> MeshReader::borrow(const HostView& view, FinalCall& release) {
  mesh_->keepers.push_back(std::make_shared<const FinalCall>(std::move(release)));
  return view.as<T>();
}

// An array of count elements, which fill(values) appends.
template <class T, class Fill>
View<T> MeshReader::own(uint64_t count, const char* what, Fill&& fill) {
  constexpr size_t kPadding = (16 + sizeof(T) - 1) / sizeof(T);
  const uint64_t bytes = (count + kPadding) * sizeof(T);
  auto array = std::make_shared<OwnArray<T>>();
  array->booking = Booking(meter_, bytes, (what + (" of " + subject_.name())).c_str());
  array->values.reserve(count + kPadding);
  fill(array->values);
  array->values.resize(count + kPadding);
  std::memset(static_cast<void*>(array->values.data() + count), 0, kPadding * sizeof(T));
  mesh_->memory += bytes;
  const View<T> view(array->values.data(), count, sizeof(T));
  mesh_->keepers.push_back(std::move(array));
  return view;
}

void MeshReader::take_positions() {
  if (positions_.borrowed) {
    mesh_->positions = borrow<Vec3>(positions_, releases_.positions);
    mesh_->positions_padded = positions_.padded;
    return;
  }
  mesh_->positions = own<Vec3>(positions_.count, "positions", [&](std::vector<Vec3>& values) {
    const View<Vec3> from = positions_.as<Vec3>();
    for (size_t i = 0; i < from.size(); ++i) values.push_back(from[i]);
  });
  mesh_->positions_padded = true;
}

void MeshReader::take_triangles() {
  if (indices_.borrowed && indices_.padded && indices_.format == BDPT_FORMAT_UINT32X3 && mesh_->degenerate == 0) {
    mesh_->triangles = borrow<Triangle>(indices_, releases_.indices);
    return;
  }
  mesh_->triangles = own<Triangle>(triangle_count() - mesh_->degenerate, "indices", [&](std::vector<Triangle>& values) {
    for (uint64_t i = 0; i < triangle_count(); ++i)
      if (const Triangle t = triangle(i); mesh_->degenerate == 0 || !is_degenerate(t)) values.push_back(t);
  });
}

// Vertex normals weigh alike, whatever their length. Those that are near enough to unit length stay as they are, so
// that a mesh is the same whether it was copied or borrowed.
Vec3 usable_normal(const Vec3& n) {
  if (std::fabs(length_squared(n) - 1) < 1e-3f) return n;
  const Imath::V3d wide(n);
  return Vec3(wide / wide.length());
}

void MeshReader::take_normals() {
  if (normals_.count == 0) return;
  const View<Vec3> from = normals_.as<Vec3>();
  bool usable = normals_.borrowed;
  for (size_t i = 0; usable && i < from.size(); ++i) usable = usable_normal(from[i]) == from[i];
  if (usable) {
    mesh_->normals = borrow<Vec3>(normals_, releases_.normals);
    return;
  }
  mesh_->normals = own<Vec3>(normals_.count, "normals", [&](std::vector<Vec3>& values) {
    for (size_t i = 0; i < from.size(); ++i) values.push_back(usable_normal(from[i]));
  });
}

void MeshReader::take_uv(int set) {
  if (uv_[set].count == 0) return;
  if (uv_[set].borrowed) {
    mesh_->uv[set] = borrow<Vec2>(uv_[set], releases_.uv[set]);
    return;
  }
  mesh_->uv[set] = own<Vec2>(uv_[set].count, set == 0 ? "uv[0]" : "uv[1]", [&](std::vector<Vec2>& values) {
    const View<Vec2> from = uv_[set].as<Vec2>();
    for (size_t i = 0; i < from.size(); ++i) values.push_back(from[i]);
  });
}

Rgba MeshReader::color(uint64_t i) const {
  if (colors_.format == BDPT_FORMAT_FLOAT4) return colors_.as<Rgba>()[i];
  const Vec3 rgb = colors_.as<Vec3>()[i];
  return {rgb.x, rgb.y, rgb.z, 1};
}

void MeshReader::take_colors() {
  if (colors_.count == 0) return;
  if (colors_.borrowed && colors_.format == BDPT_FORMAT_FLOAT4) {
    mesh_->colors = borrow<Rgba>(colors_, releases_.colors);
    return;
  }
  mesh_->colors = own<Rgba>(colors_.count, "colors", [&](std::vector<Rgba>& values) {
    for (size_t i = 0; i < colors_.count; ++i) values.push_back(color(i));
  });
}

void MeshReader::take_tangents() {
  if (tangents_.count == 0) return;
  if (tangents_.borrowed) {
    mesh_->tangents = borrow<Tangent>(tangents_, releases_.tangents);
    return;
  }
  mesh_->tangents = own<Tangent>(tangents_.count, "tangents", [&](std::vector<Tangent>& values) {
    const View<Tangent> from = tangents_.as<Tangent>();
    for (size_t i = 0; i < from.size(); ++i) values.push_back(from[i]);
  });
}

// Of the values alone: the same for every stride, index format and ownership.
template <class T>
uint64_t hash_view(const View<T>& view, uint64_t h) {
  constexpr size_t kPiece = 1024;
  h = hash_combine(h, view.size());
  T piece[kPiece];
  for (size_t first = 0; first < view.size(); first += kPiece) {
    const size_t count = std::min(kPiece, view.size() - first);
    for (size_t i = 0; i < count; ++i) piece[i] = view[first + i];
    h = hash_bytes(piece, count * sizeof(T), h);
  }
  return h;
}

uint64_t MeshReader::content_hash() const {
  uint64_t h = hash_view(mesh_->positions, 0);
  h = hash_view(mesh_->triangles, h);
  h = hash_view(mesh_->normals, h);
  h = hash_view(mesh_->uv[0], h);
  h = hash_view(mesh_->uv[1], h);
  if (!mesh_->colors.empty()) h = hash_view(mesh_->colors, h);
  if (!mesh_->tangents.empty()) h = hash_view(mesh_->tangents, hash_combine(h, 1));
  return h;
}

}  // namespace

MeshReleases::MeshReleases(const bdpt_mesh_desc* desc)
    : MeshReleases(is_readable(desc) ? copy_readable(*desc) : bdpt_mesh_desc{}) {}

MeshReleases::MeshReleases(const bdpt_mesh_desc& desc)
    : positions(final_call(desc.positions)),
      indices(final_call(desc.indices)),
      normals(final_call(desc.normals)),
      uv{final_call(desc.uv[0]), final_call(desc.uv[1])},
      colors(final_call(desc.colors)),
      tangents(final_call(desc.tangents)) {}

std::shared_ptr<const Mesh> read_mesh(const bdpt_mesh_desc& desc, MeshReleases& releases,
                                      const std::shared_ptr<MemoryMeter>& meter) {
  return MeshReader(desc, releases, meter).read();
}

}  // namespace bdpt
