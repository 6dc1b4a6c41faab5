// Outputs of sensors, as the host asks for them.
#pragma once

#include "api/check.h"
#include "api/desc.h"
#include "bake/outputs.h"

namespace bdpt {

// Element i of an array of structs that is stride bytes from one to the next; 0 = packed.
template <class T>
const T* element(const T* array, uint64_t i, uint64_t stride) {
  return reinterpret_cast<const T*>(reinterpret_cast<const char*>(array) + i * (stride ? stride : sizeof(T)));
}

// The outputs asked for; `otherwise` alone where none are.
std::vector<OutputDesc> read_outputs(const bdpt_output_desc* outputs, uint32_t count, uint32_t stride,
                                     OutputKind otherwise);

}  // namespace bdpt
