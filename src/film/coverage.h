// Whose surfaces the samples of a pixel met, and how often. A pixel keeps so many ids: of more, those whose hashes come
// first. Which ones are kept, and that they are kept with all their samples, is then the same for any order of samples,
// passes and merged ranges.
#pragma once

#include "sampling/hash.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace bdpt {

struct CoverageSlot {
  uint64_t id, samples;  // no samples: empty
};

struct PixelCoverage {
  static constexpr size_t kSlots = 8;
  CoverageSlot slots[kSlots] = {};  // in the order of comes_before(), the empty ones last
  uint64_t lost = 0;                // samples of ids that are not kept

  void add(uint64_t id, uint64_t samples) {
    for (CoverageSlot& slot : slots) {
      if (slot.samples > 0 && slot.id == id) {
        slot.samples += samples;
        return;
      }
      if (slot.samples > 0 && !comes_before(id, slot.id)) continue;
      lost += slots[kSlots - 1].samples;
      std::copy_backward(&slot, slots + kSlots - 1, slots + kSlots);
      slot = {id, samples};
      return;
    }
    lost += samples;
  }
  void add(const PixelCoverage& o) {
    for (const CoverageSlot& slot : o.slots)
      if (slot.samples > 0) add(slot.id, slot.samples);
    lost += o.lost;
  }

 private:
  static bool comes_before(uint64_t a, uint64_t b) {
    const uint64_t key_a = hash_values(a), key_b = hash_values(b);
    return key_a != key_b ? key_a < key_b : a < b;
  }
};

}  // namespace bdpt
