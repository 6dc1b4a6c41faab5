// The host's buffers of texels.
#pragma once

#include "api/check.h"

#include <cstdint>

namespace bdpt {

// Both 1 to 65536, and at most 2^28 texels.
void check_atlas_size(const Subject& subject, uint32_t width, uint32_t height);

void check_channels(const Subject& subject, uint32_t channels);

// A buffer that must be there, aligned, and of at least so many bytes; its size is in the field <field>_capacity unless
// it is named.
void check_buffer(const Subject& subject, const char* field, const void* data, size_t alignment, uint64_t capacity,
                  uint64_t needed, const char* capacity_field = nullptr);

// The bytes from one element of the host's array to the next; 0 stands for their size.
uint32_t read_stride(const Subject& subject, const char* field, uint32_t stride, uint32_t size);

}  // namespace bdpt
