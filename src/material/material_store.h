// Materials whose numbers belong to one vertex alone. They stay where they are until all are cleared.
#pragma once

#include "material/material.h"

#include <memory>
#include <vector>

namespace bdpt {

class MaterialStore {
 public:
  Material& add(const Material& material) {
    if (count_ == chunks_.size() * kChunk) chunks_.push_back(std::make_unique<Material[]>(kChunk));
    Material& added = chunks_[count_ / kChunk][count_ % kChunk];
    ++count_;
    return added = material;
  }
  void clear() { count_ = 0; }
  size_t memory() const { return chunks_.size() * kChunk * sizeof(Material); }

 private:
  static constexpr size_t kChunk = 64;
  std::vector<std::unique_ptr<Material[]>> chunks_;
  size_t count_ = 0;
};

}  // namespace bdpt
