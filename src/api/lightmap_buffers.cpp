#include "api/lightmap_buffers.h"

namespace bdpt {
namespace {

constexpr uint64_t kMaxTexels = uint64_t(1) << 28;
constexpr uint32_t kMaxChannels = 4096;
constexpr uint32_t kMaxStride = 4096;

}  // namespace

void check_atlas_size(const Subject& subject, uint32_t width, uint32_t height) {
  for (const auto& [field, value] : {std::pair("width", width), std::pair("height", height)})
    if (value < 1 || value > kMaxImageSide)
      subject.refuse(field, "is ", value, ": give 1 to ", kMaxImageSide, " texels");
  if (uint64_t(width) * height > kMaxTexels)
    subject.refuse("width times height", "is ", uint64_t(width) * height, ": give at most ", kMaxTexels, " texels");
}

void check_channels(const Subject& subject, uint32_t channels) {
  if (channels < 1 || channels > kMaxChannels)
    subject.refuse("channels", "is ", channels, ": give 1 to ", kMaxChannels, " floats to a texel");
}

void check_buffer(const Subject& subject, const char* field, const void* data, size_t alignment, uint64_t capacity,
                  uint64_t needed, const char* capacity_field) {
  if (!data) subject.refuse(field, "is NULL: pass a buffer of ", needed, " bytes");
  if (reinterpret_cast<uintptr_t>(data) % alignment != 0)
    subject.refuse(field, "is ", data, ": align it to ", alignment, " bytes");
  if (capacity < needed)
    subject.refuse(capacity_field ? capacity_field : (std::string(field) + "_capacity").c_str(), "is ", capacity,
                   " bytes: ", needed, " are needed");
}

uint32_t read_stride(const Subject& subject, const char* field, uint32_t stride, uint32_t size) {
  if (stride == 0) return size;
  if (stride < size || stride > kMaxStride || stride % alignof(void*) != 0)
    subject.refuse(field, "is ", stride, ": give the size of the element's struct (", size, "), or 0");
  return stride;
}

}  // namespace bdpt
