// Checks of single fields. Each throws with a text that names field, object and value and says what to do.
#pragma once

#include "base/error.h"
#include "math/transform.h"
#include "math/vec.h"

#include <cmath>
#include <cstdint>
#include <string>

namespace bdpt {

constexpr uint32_t kMaxImageSide = 65536;  // pixels or texels

// The object a field belongs to: kind and the host's label for it.
class Subject {
 public:
  Subject(const char* kind, const char* label) : kind_(kind), label_(label ? label : "") {}
  const char* kind() const { return kind_; }
  const std::string& label() const { return label_; }
  // 'material "gold"', or 'the material' where there is no label.
  std::string name() const {
    return label_.empty() ? std::string("the ") + kind_ : std::string(kind_) + " \"" + label_ + '"';
  }

  // Throws InvalidArgument: "<field> of <name> <parts>".
  template <class... Parts>
  [[noreturn]] void refuse(const char* field, const Parts&... parts) const {
    fail(ErrorCode::InvalidArgument, field, " of ", name(), " ", parts...);
  }

  void check_finite(const char* field, float v) const;
  void check_finite(const char* field, const float* v, int n) const;
  void check_range(const char* field, double v, double low, double high) const;  // [low, high]
  void check_range(const char* field, const float* v, int n, double low, double high) const;
  void check_not_negative(const char* field, const float* v, int n) const;  // and finite
  void check_flag(const char* field, uint32_t v) const;                     // 0 or 1
  void check_reserved(const char* field, uint32_t v) const;                 // 0
  void check_enum(const char* field, int32_t v, int32_t last) const;        // [0, last]

 private:
  const char* kind_;
  std::string label_;
};

// Throws where no file is named.
inline void check_path(const char* path) {
  if (!path || !*path) fail(ErrorCode::InvalidArgument, "path is ", path ? "empty" : "NULL", ": name a file");
}

inline std::string text_or_empty(const char* text) { return text ? text : ""; }
inline Vec3 to_vec3(const float v[3]) { return {v[0], v[1], v[2]}; }
inline Rgb to_rgb(const float v[3]) { return {v[0], v[1], v[2]}; }

}  // namespace bdpt
