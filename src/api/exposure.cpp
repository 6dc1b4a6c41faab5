#include "api/check.h"
#include "api/desc.h"

using namespace bdpt;

namespace {

// ISO 12232: the exposure H that saturates, in lux seconds, is 78 / S. H = q L t / N^2, with q = 0.65 for the lens.
constexpr double kSaturation = 78, kLens = 0.65;

double exposure_value(const bdpt_exposure_desc& d) {
  const Subject subject("desc", nullptr);
  subject.check_reserved("reserved", d.reserved);
  if (d.shutter_time == 0 && d.f_number == 0) {
    if (d.iso != 0)
      subject.refuse("iso", "is ", d.iso, " with no shutter_time and f_number: give the three, or ev100 alone");
    subject.check_range("ev100", d.ev100, -64, 64);
    return double(d.ev100);
  }
  if (d.ev100 != 0) subject.refuse("ev100", "is ", d.ev100, " beside shutter_time and f_number: give one or the other");
  if (d.iso != 0) subject.check_range("iso", d.iso, 1, 1e7);
  subject.check_range("shutter_time", d.shutter_time, 1e-7f, 1e7);
  subject.check_range("f_number", d.f_number, 0.1f, 1000);
  const double iso = d.iso == 0 ? 100 : double(d.iso);
  return std::log2(double(d.f_number) * double(d.f_number) / double(d.shutter_time) * 100 / iso);
}

}  // namespace

bdpt_result bdpt_exposure_stops(const bdpt_exposure_desc* desc, float* stops) {
  return guard(__func__, [&] {
    const bdpt_exposure_desc d = read_struct(desc, "desc");
    require(stops, "stops");
    *stops = float(-exposure_value(d) - std::log2(kSaturation / (100 * kLens)));
  });
}
