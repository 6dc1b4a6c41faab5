// Sensors that are no cameras, for tests.
#pragma once

#include "bake/lightmap.h"
#include "bake/points.h"
#include "rendering.h"
#include "transport/plan.h"

namespace bdpt::baking {

using namespace rendering;

inline LightmapInstance placed(uint32_t instance) {
  LightmapInstance i;
  i.instance = instance;
  return i;
}

inline std::shared_ptr<const Lightmap> lightmap(const ScenePointer& scene, int side,
                                                const std::vector<LightmapInstance>& instances = {placed(0)},
                                                const std::vector<OutputDesc>& outputs = {OutputDesc{}},
                                                const BurialDesc& burial = {}) {
  LightmapDesc desc{instances, {side, side, 1}, {0, 0, side, side}};
  desc.burial = burial;
  return std::make_shared<const Lightmap>(scene, desc, outputs, nullptr);
}

inline std::shared_ptr<const Points> points(const std::vector<MeasuredPoint>& places,
                                            const std::vector<OutputDesc>& outputs) {
  return std::make_shared<const Points>(places, outputs);
}

inline TransportOptions with_plan(TransportOptions options, const char* plan) {
  options.plan = find_plan(plan);
  return options;
}

// What takes part, alone or together: each of these measures all light in a scene without mirrors and points.
struct Way {
  std::string name;
  TransportOptions options;
};
inline std::vector<Way> ways(int max_edges) {
  const auto way = [&](const char* name, const std::function<bool(int, int)>& allows) {
    return Way{name, options_for(mask_of(allows), max_edges)};
  };
  std::vector<Way> all = {way("s = 0", [](int s, int) { return s == 0; }),
                          way("s <= 1, t >= 1", [](int s, int t) { return s <= 1 && t >= 1; }),
                          way("t = 0", [](int, int t) { return t == 0; }),
                          way("t = 1", [](int, int t) { return t == 1; }), way("all", [](int, int) { return true; })};
  for (const char* plan : {"two-way", "pooled", "matrix", "combinatorial", "automatic"})
    all.push_back({plan, with_plan(options_for({}, max_edges), plan)});
  return all;
}

}  // namespace bdpt::baking
