// The instances of a scene that a sensor names, each by its builder's id and once.
#pragma once

#include "api/check.h"
#include "scene/scene.h"

#include <string>
#include <unordered_map>
#include <vector>

namespace bdpt {

class NamedInstances {
 public:
  explicit NamedInstances(const Scene& scene) : scene_(scene), numbers_(scene.instance_count(), -1) {
    for (uint32_t i = 0; i < scene.instance_count(); ++i) indices_.emplace(scene.instance_id(i), i);
  }
  // The scene's index of an id; name: as errors call it.
  uint32_t find(const std::string& name, uint64_t id) const {
    const auto found = indices_.find(id);
    if (found == indices_.end())
      fail(ErrorCode::InvalidId, name,
           " is none of the scene's: give an id that the builder had when it built the scene");
    if (scene_.moves(found->second))
      fail(ErrorCode::InvalidArgument, name, " is an instance that moves: measure at one that stands still");
    return found->second;
  }
  // An instance is the array's element `number`. remedy: how to name it once.
  void take(const Subject& subject, uint32_t instance, uint32_t number, const char* remedy) {
    int& known = numbers_[instance];
    if (known >= 0) subject.refuse("instances", "has one instance twice, as ", known, " and ", number, ": ", remedy);
    known = int(number);
  }

 private:
  const Scene& scene_;
  std::unordered_map<uint64_t, uint32_t> indices_;
  std::vector<int> numbers_;  // of each of the scene's; -1 = not named
};

}  // namespace bdpt
