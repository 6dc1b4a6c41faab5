#include "denoise/denoiser.h"

#include "api/check.h"
#include "api/desc.h"

using namespace bdpt;

namespace {

constexpr uint32_t kMaxDenoiserThreads = 1024;

void check_image(const Subject& subject, const char* name, const float* pixels) {
  if (reinterpret_cast<uintptr_t>(pixels) % alignof(float) != 0)
    subject.refuse(name, "is ", pixels, ": align it to 4 bytes");
}

}  // namespace

int32_t bdpt_has_denoiser() {
  try {
    return has_denoiser() ? 1 : 0;
  } catch (...) {  // no memory to look for it
    return 0;
  }
}

bdpt_result bdpt_denoise(const bdpt_denoise_desc* desc) {
  return guard(__func__, [&] {
    const bdpt_denoise_desc d = read_struct(desc, "desc");
    const Subject subject("desc", nullptr);
    subject.check_range("width", d.width, 1, kMaxImageSide);
    subject.check_range("height", d.height, 1, kMaxImageSide);
    subject.check_flag("clean", d.clean);
    subject.check_range("threads", d.threads, 0, kMaxDenoiserThreads);
    subject.check_reserved("reserved", d.reserved);
    require(d.color, "desc.color");
    require(d.output, "desc.output");
    if (d.normal && !d.albedo)
      subject.refuse("albedo", "is NULL although there is a normal: give both, or albedo alone");
    if (d.clean && !d.albedo) subject.refuse("clean", "is 1 although there is neither albedo nor normal: give 0");
    check_image(subject, "color", d.color);
    check_image(subject, "albedo", d.albedo);
    check_image(subject, "normal", d.normal);
    check_image(subject, "output", d.output);
    denoise({d.width, d.height, d.color, d.albedo, d.normal, d.output, d.clean != 0}, d.threads);
  });
}
