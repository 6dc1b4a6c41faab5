#include "api/host_view.h"

#include <string>

namespace bdpt {
namespace {

struct Format {
  uint32_t size, alignment;
};

constexpr Format kFormats[] = {{0, 1}, {8, 4}, {12, 4}, {6, 2}, {12, 4}, {16, 4}, {4, 4}, {4, 4}};
constexpr uint64_t kPadding = 16;
// Primitives and vertices are counted in 32 bits, and the last number means none.
constexpr uint64_t kMaxCount = 0xFFFFFFFEu;
// More than any process can address; keeps the arithmetic below from overflowing.
constexpr uint64_t kMaxStride = uint64_t(1) << 24;

}  // namespace

HostView read_view(const Subject& subject, const char* field, const bdpt_data& data, uint32_t formats) {
  const auto name = [&](const char* member) { return std::string(field) + '.' + member; };
  subject.check_enum(name("format").c_str(), data.format, BDPT_FORMAT_UINT32);
  subject.check_enum(name("ownership").c_str(), data.ownership, BDPT_OWNERSHIP_BORROW);
  if (data.count == 0) return {};
  if (!(formats >> data.format & 1u))
    subject.refuse(name("format").c_str(), "is ", data.format,
                   ": the array holds something else; see the description of the struct");
  const Format format = kFormats[data.format];
  if (data.count > kMaxCount) subject.refuse(name("count").c_str(), "is ", data.count, ": give at most ", kMaxCount);
  if (!data.data) subject.refuse(name("data").c_str(), "is NULL for ", data.count, " elements: pass the array");
  if (reinterpret_cast<uintptr_t>(data.data) % format.alignment != 0)
    subject.refuse(name("data").c_str(), "is ", data.data, ": align it to ", format.alignment, " bytes");
  const uint64_t stride = data.stride ? data.stride : format.size;
  if (stride < format.size || stride > kMaxStride || stride % format.alignment != 0)
    subject.refuse(name("stride").c_str(), "is ", stride, ": give a multiple of ", format.alignment, " from ",
                   format.size, " to ", kMaxStride, ", or 0 for packed elements");
  HostView view;
  view.data = static_cast<const std::byte*>(data.data);
  view.count = data.count;
  view.stride = stride;
  view.format = data.format;
  view.borrowed = data.ownership == BDPT_OWNERSHIP_BORROW;
  view.padded = data.slack_bytes >= kPadding;
  return view;
}

Triangle read_triangle(const HostView& indices, uint64_t i) {
  switch (indices.format) {
    case BDPT_FORMAT_UINT32X3:
      return indices.as<Triangle>()[i];
    case BDPT_FORMAT_UINT16X3: {
      uint16_t v[3];
      std::memcpy(v, indices.data + i * indices.stride, sizeof v);
      return {v[0], v[1], v[2]};
    }
    default: {
      const uint32_t first = static_cast<uint32_t>(3 * i);
      return {first, first + 1, first + 2};
    }
  }
}

void check_finite_view(const Subject& subject, const char* field, const HostView& view) {
  const int n = int(kFormats[view.format].size / sizeof(float));
  for (uint64_t i = 0; i < view.count; ++i) {
    float v[4];
    std::memcpy(v, view.data + i * view.stride, sizeof(float) * size_t(n));
    for (int c = 0; c < n; ++c)
      if (!std::isfinite(v[c]))
        subject.refuse(field, "has the value ", v[c], " in element ", i, ": give finite numbers");
  }
}

}  // namespace bdpt
