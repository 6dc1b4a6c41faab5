// What a wave of hits asks of the host's textures: gathered first, answered by one call for each texture.
#pragma once

#include "geometry/host_texture.h"

#include <memory>
#include <vector>

namespace bdpt {

class HostLookups {
 public:
  using Textures = std::vector<std::shared_ptr<const HostTexture>>;

  // A new wave.
  void clear() {
    hits_.clear();
    answers_.clear();
    for (Queue& queue : queues_) queue.clear();
  }
  // The hit that the next places are of.
  void add_hit() { hits_.push_back({uint32_t(answers_.size()), true}); }
  void add(size_t texture, const TexturePlace& place) {
    if (texture >= queues_.size()) queues_.resize(texture + 1);
    queues_[texture].places.push_back(place);
    queues_[texture].answers.push_back({uint32_t(answers_.size()), uint32_t(hits_.size() - 1)});
    answers_.emplace_back();
  }
  void ask(const Textures& textures);

  // Colours for a hit's places, in their order.
  const Rgba* of(size_t hit) const { return answers_.data() + hits_[hit].first; }
  // False where one of them is not what was promised.
  bool is_sound(size_t hit) const { return hits_[hit].is_sound; }
  size_t memory() const;

 private:
  struct HitAnswers {
    uint32_t first;
    bool is_sound;
  };
  struct Place {
    uint32_t answer, hit;
  };
  struct Queue {
    std::vector<TexturePlace> places;
    std::vector<Place> answers;  // where each place's colour goes
    void clear() { places.clear(), answers.clear(); }
  };

  std::vector<HitAnswers> hits_;
  std::vector<Queue> queues_;  // by texture
  std::vector<Rgba> answers_, colors_;
};

}  // namespace bdpt
