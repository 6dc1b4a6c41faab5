// Whether points of surfaces lie inside of geometry: there the first things that rays meet are backs.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <vector>

namespace bdpt {

// Calls body(i) for each i in [0, n), perhaps from several threads at once.
using Parallel = std::function<void(uint32_t n, const std::function<void(uint32_t)>& body)>;

struct BurialDesc {
  int rays = 0;            // from each point; 0 = nothing is looked for
  float tolerance = 0.5f;  // the part of them that may meet backs
  bool all_backs = false;  // backs of all surfaces that let no light through; else of one-sided ones alone
  Parallel parallel = {};  // empty = here
};

class Burial {
 public:
  // A point of a surface, and the unit normal of the side that receives.
  struct Place {
    Vec3 p, normal;
    float margin;
  };

  Burial(const Scene& scene, const BurialDesc& desc);

  // Whether any of these places has a back in front of it, by one ray each, of all directions in turn.
  bool suspects(const std::vector<Place>& places) const;
  // Whether more rays than tolerated meet backs, of each.
  std::vector<uint8_t> test(const std::vector<Place>& places) const;

 private:
  Ray ray(const Place& place, size_t number) const;
  void trace(const std::vector<Ray>& rays, std::vector<uint8_t>& backs) const;

  const Scene& scene_;
  std::vector<Vec3> directions_;  // by the cosine, round the z axis
  float most_;                    // rays that may meet backs
  bool all_backs_;
};

}  // namespace bdpt
