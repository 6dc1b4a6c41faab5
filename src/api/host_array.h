// Arrays of structs that the host hands over: element by element, some bytes apart.
#pragma once

#include "api/check.h"

namespace bdpt {

// What the bytes from one element to the next may be; 0 stands for packed ones.
inline void check_stride(const Subject& subject, const char* field, uint64_t stride, uint64_t least,
                         uint64_t multiple) {
  if (stride != 0 && (stride < least || stride % multiple != 0))
    subject.refuse(field, "is ", stride, ": give a multiple of ", multiple, " from ", least, ", or 0 for packed ones");
}

template <class T>
const T& element(const T* array, uint64_t i, uint64_t stride) {
  return *reinterpret_cast<const T*>(reinterpret_cast<const std::byte*>(array) + i * (stride ? stride : sizeof(T)));
}

}  // namespace bdpt
