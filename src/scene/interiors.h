// What encloses a point: the closed surfaces that rays have entered and not left, and which of them counts.
//
// Where several overlap, the one of highest priority is what is there, and of equal ones that which was entered last
// (Schmidt and Budge 2002). The surfaces of the others are no boundaries there: rays pass.
#pragma once

#include "medium/medium.h"

#include <array>
#include <cstdint>
#include <vector>

namespace bdpt {

// Numbers of materials that enclose something, in the order in which they were entered; at most four at once.
class Interior {
 public:
  bool operator==(const Interior&) const = default;
  bool is_empty() const { return packed_ == 0; }
  bool is_full() const { return packed_ >> 48 != 0; }
  // is_full() must not be.
  Interior entered(uint16_t number) const { return Interior(packed_ << 16 | number); }
  // Without the one entered last of this number; the same where it is not there.
  Interior left(uint16_t number) const {
    for (int i = 0; i < 4; ++i)
      if (at(i) == number) {
        const uint64_t low = packed_ & ((1ull << (16 * i)) - 1);
        return Interior(i == 3 ? low : (packed_ >> (16 * (i + 1)) << (16 * i)) | low);
      }
    return *this;
  }
  // 0 is the one entered last; 0 for none.
  uint16_t at(int i) const { return uint16_t(packed_ >> (16 * i)); }
  Interior() = default;

 private:
  explicit Interior(uint64_t packed) : packed_(packed) {}
  uint64_t packed_ = 0;
};

// What the surfaces of a scene enclose, by number; 0 is the space outside of all.
class Interiors {
 public:
  struct Enclosure {
    const Medium* medium = nullptr;
    float ior = 1;
    bool refracts = false;  // else it has the index of what is round it
    uint32_t priority = 0;
  };
  Interiors() : enclosures_(1) {}
  void set_outside(const Medium* medium) { enclosures_[0].medium = medium; }
  uint16_t add(const Enclosure& enclosure) {
    enclosures_.push_back(enclosure);
    return uint16_t(enclosures_.size() - 1);
  }

  const Medium* medium(const Interior& interior) const { return enclosures_[top(interior)].medium; }
  float ior(const Interior& interior) const { return enclosures_[top(interior, true)].ior; }
  // Whether a surface that encloses `number` is a boundary within `others`, which does not count it.
  bool is_boundary(const Interior& others, uint16_t number) const {
    const uint16_t best = top(others);
    return best == 0 || enclosures_[number].priority >= enclosures_[best].priority;
  }

 private:
  // What counts there, or of what refracts.
  uint16_t top(const Interior& interior, bool refracting = false) const {
    uint16_t best = 0;
    for (int i = 3; i >= 0; --i) {  // of equals the last
      const uint16_t n = interior.at(i);
      if (n == 0 || (refracting && !enclosures_[n].refracts)) continue;
      if (best == 0 || enclosures_[n].priority >= enclosures_[best].priority) best = n;
    }
    return best;
  }

  std::vector<Enclosure> enclosures_;
};

}  // namespace bdpt
