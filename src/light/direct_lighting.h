// Direct lighting: how s = 1 chooses y0 for a point that is lit, and P_A^d, its density (Veach 10.3.4.2).
//
// P_A^d is a function of y0 and the receiver alone, so that every technique can know it.
#pragma once

#include "light/lights.h"

namespace bdpt {

enum class LightSelection {
  Power,    // one light, by emitted power
  Uniform,  // one light, each alike
  Tree,     // one emitter, by what it may send to the receiver; a mesh is as many as it has triangles
  Each,     // every light in turn
};

class DirectLighting {
 public:
  DirectLighting(const Lights& lights, LightSelection selection);

  // Lights to take in turn: all of them, or the one that is chosen.
  int turns() const { return selection_ == LightSelection::Each ? int(lights_.count()) : 1; }
  // Chooses y0 in a turn. u chooses the light and the part of it, u1 and u2 the point. False where the light
  // chosen cannot reach x.
  bool sample(const Receiver& x, int turn, double u, float u1, float u2, DirectLight& direct) const;
  // P_A^d(y0) at x; where lights take turns, the sum of the turns' densities.
  float density(const LightPoint& y0, const Receiver& x) const;
  size_t memory() const { return tree_.memory(); }

 private:
  struct Place {
    int light;
    uint32_t triangle;
    double rest;  // of u
  };
  // With the light's probability given x, whichever the selection.
  float density(const LightPoint& y0, const Receiver& x, float chosen) const;
  // Of a light or an emitter of the tree's.
  float choice(const LightPoint& y0, const Receiver& x) const;
  Place choose(const Receiver& x, int turn, double u, float& chosen) const;
  Place choose_by_tree(const Receiver& x, double u, float& chosen) const;

  const Lights& lights_;
  LightSelection selection_;
  LightTree tree_;
  Discrete infinite_;         // infinite lights by power, beside the tree,
  float infinite_share_ = 0;  // and the share of all of them
};

}  // namespace bdpt
