#include "api/desc.h"

namespace bdpt {

void check_struct_size(const void* data, uint32_t version_1, uint32_t own, const char* name) {
  uint32_t size;
  std::memcpy(&size, data, sizeof size);
  if (size < version_1 || size > kMaxStructSize)
    fail(ErrorCode::InvalidArgument, name, ".struct_size is ", size,
         ", which no version of the struct has: set it to "
         "sizeof the struct (",
         own, " in this library)");
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (uint32_t i = own; i < size; ++i)
    if (bytes[i] != 0)
      fail(ErrorCode::InvalidArgument, name, " is ", size, " bytes, and byte ", i,
           " is not zero: this library knows the "
           "first ",
           own, " and cannot do what a later field asks for");
}

}  // namespace bdpt
