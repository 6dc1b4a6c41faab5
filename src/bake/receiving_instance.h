// Which instance of a scene receives the light that is measured, and on which side.
#pragma once

#include <cstdint>

namespace bdpt {

struct ReceivingInstance {
  uint32_t instance = 0;
  bool flip = false;  // on the back
};

}  // namespace bdpt
