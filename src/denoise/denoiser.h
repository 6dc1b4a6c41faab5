// Open Image Denoise, where its library is there at run time. Nothing of it is linked.
#pragma once

#include <cstdint>

namespace bdpt {

struct DenoiseImages {
  uint32_t width, height;
  const float *color, *albedo, *normal;  // 3 floats to a pixel, packed; the last two may be null
  float* output;
  bool clean;  // albedo and normal have no noise
};

// Looks for the library at the first call.
bool has_denoiser();
// threads: 0 = one per core. Errors: Unsupported (it is not there, or too old), Internal (it failed).
void denoise(const DenoiseImages& images, uint32_t threads);

}  // namespace bdpt
