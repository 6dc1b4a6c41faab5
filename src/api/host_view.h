// One of the host's strided arrays, checked to be readable as what it says it is.
#pragma once

#include "api/check.h"
#include "bdpt.h"
#include "geometry/mesh.h"

namespace bdpt {

struct HostView {
  const std::byte* data = nullptr;
  uint64_t count = 0, stride = 0;
  bdpt_format format = BDPT_FORMAT_NONE;
  bool borrowed = false;
  bool padded = false;  // 16 readable bytes behind the last element, which is what Embree asks for

  template <class T>
  View<T> as() const {
    return View<T>(data, count, stride);
  }
};

constexpr uint32_t format_bit(bdpt_format format) { return 1u << format; }

// formats: those allowed, as bits. An absent view has count 0.
HostView read_view(const Subject& subject, const char* field, const bdpt_data& data, uint32_t formats);

// Triangle i of an array of indices; of an absent one, vertices 3i, 3i + 1, 3i + 2.
Triangle read_triangle(const HostView& indices, uint64_t i);

// Throws unless all components are finite.
void check_finite_view(const Subject& subject, const char* field, const HostView& view);

}  // namespace bdpt
