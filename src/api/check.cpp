#include "api/check.h"

namespace bdpt {
namespace {

// "reflectance[1]"
std::string element(const char* field, int i, int n) {
  return n == 1 ? field : std::string(field) + '[' + std::to_string(i) + ']';
}

}  // namespace

void Subject::check_finite(const char* field, float v) const { check_finite(field, &v, 1); }

void Subject::check_finite(const char* field, const float* v, int n) const {
  for (int i = 0; i < n; ++i)
    if (!std::isfinite(v[i])) refuse(element(field, i, n).c_str(), "is ", v[i], ": give a finite number");
}

void Subject::check_range(const char* field, double v, double low, double high) const {
  if (!(v >= low && v <= high)) refuse(field, "is ", v, ": give a value from ", low, " to ", high);
}

void Subject::check_range(const char* field, const float* v, int n, double low, double high) const {
  for (int i = 0; i < n; ++i) check_range(element(field, i, n).c_str(), v[i], low, high);
}

void Subject::check_not_negative(const char* field, const float* v, int n) const {
  check_finite(field, v, n);
  for (int i = 0; i < n; ++i)
    if (v[i] < 0) refuse(element(field, i, n).c_str(), "is ", v[i], ": give a value of at least 0");
}

void Subject::check_flag(const char* field, uint32_t v) const {
  if (v > 1) refuse(field, "is ", v, ": give 0 or 1");
}

void Subject::check_reserved(const char* field, uint32_t v) const {
  if (v != 0) refuse(field, "is ", v, ": this field has no meaning yet and must be 0");
}

void Subject::check_enum(const char* field, int32_t v, int32_t last) const {
  if (v < 0 || v > last) refuse(field, "is ", v, ": that is none of the constants of bdpt.h for it (0 to ", last, ")");
}

}  // namespace bdpt
