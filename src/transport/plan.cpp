#include "transport/plan.h"

#include <cstring>

namespace bdpt {

extern const Plan kOneToOne, kTwoWay, kPooled, kMatrix, kCombinatorial, kMmlt, kAutomatic;

const Plan* const kPlans[] = {&kOneToOne, &kTwoWay, &kPooled, &kMatrix, &kCombinatorial, &kMmlt, &kAutomatic, nullptr};

const Plan* find_plan(const char* name) {
  for (const Plan* const* p = kPlans; *p; ++p)
    if (std::strcmp((*p)->name, name) == 0) return *p;
  return nullptr;
}

const Plan* plan_at(size_t index) {
  for (const Plan* const* p = kPlans; *p; ++p, --index)
    if (index == 0) return *p;
  return nullptr;
}

}  // namespace bdpt
