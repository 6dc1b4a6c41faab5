// Connection plans: which light vertices meet which eye vertices.
#pragma once

#include "transport/block.h"

namespace bdpt {

// Veach's own: the i-th eye with the i-th light subpath of the block, every prefix with every suffix (10.1).
void plan_one_to_one(Block& block);

}  // namespace bdpt
