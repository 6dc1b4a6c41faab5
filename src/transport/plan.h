// Connection plans: which light vertices meet which eye vertices. All else of the algorithms of this family is shared:
// a plan is one file in plans/ and one line in the table of plan.cpp. docs/plans.md shows how to add one.
#pragma once

#include "transport/block.h"

namespace bdpt {

struct Plan {
  const char* name;
  const char* summary;  // one line, for lists

  // Which of the techniques asked for it does; the weights know of no others.
  bool (*serves)(int s, int t);
  // n_{s,t}; light_vertices: the mean number of vertices of a light subpath that can be joined, by the pilot.
  SampleCounts (*counts)(const TransportOptions& options, double light_vertices);
  // Joins the eye subpaths of a block to light vertices, s >= 2 and t >= 2. All else is done before.
  void (*connect)(Block& block);

  // Does all of a block's work itself, by the samples it chooses: block.sample_... Else they are the pixels'.
  void (*run)(Block& block, uint64_t pass, const PixelRect& rect) = nullptr;

  bool pooled = false;          // eye vertices meet the light vertices of the whole pass: needs a LightPool
  int default_connections = 0;  // light vertices met by an eye vertex, where `connections` chooses them; else 0
  uint32_t block_size = 0;      // pixels; 0 = the plan's result does not depend on it
  bool resizable = false;       // pool_pixels may say another block_size
  uint64_t passes = 1;          // passes that a block takes at once, unless pool_passes says otherwise
  bool chains = false;     // of paths: a path must be what its numbers say, so that there is one of everything, one
                           // light subpath, one point on lights, and no roulette of shadow rays
  bool chooses = false;    // tiles get strategies of their own, of other plans
  uint32_t in_flight = 0;  // samples that a block has in hand at once; 0 = all of its own
};

extern const Plan kPath;  // path tracing as a strategy of tiles; no plan to ask for

// Ends with nullptr.
extern const Plan* const kPlans[];
const Plan* find_plan(const char* name);  // nullptr if there is none
const Plan* plan_at(size_t index);        // nullptr past the last

// An eye subpath with its own light subpaths, every prefix with every suffix (one-to-one; chains).
void connect_own(Block& block);
// For plans that do all.
inline bool serves_all(int, int) { return true; }

}  // namespace bdpt
