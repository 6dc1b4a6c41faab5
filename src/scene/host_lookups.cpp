#include "scene/host_lookups.h"

#include <limits>

namespace bdpt {

void HostLookups::ask(const Textures& textures) {
  constexpr float kUnset = std::numeric_limits<float>::quiet_NaN();
  for (size_t i = 0; i < queues_.size(); ++i) {
    const Queue& queue = queues_[i];
    if (queue.places.empty()) continue;
    colors_.assign(queue.places.size(), {kUnset, kUnset, kUnset, kUnset});
    textures[i]->look_up(queue.places.size(), queue.places.data(), colors_.data());
    for (size_t k = 0; k < colors_.size(); ++k) {
      answers_[queue.answers[k].answer] = colors_[k];
      if (!textures[i]->keeps_promise(colors_[k])) hits_[queue.answers[k].hit].is_sound = false;
    }
  }
}

size_t HostLookups::memory() const {
  size_t bytes = hits_.capacity() * sizeof(HitAnswers) + (answers_.capacity() + colors_.capacity()) * sizeof(Rgba);
  for (const Queue& queue : queues_)
    bytes += queue.places.capacity() * sizeof(TexturePlace) + queue.answers.capacity() * sizeof(Place);
  return bytes;
}

}  // namespace bdpt
