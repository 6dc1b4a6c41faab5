#include "api/builder.h"

using namespace bdpt;

namespace {

// The one number that is shared by all contexts: it only tells builders apart.
std::atomic<uint64_t> next_builder_tag{1};

}  // namespace

bdpt_result bdpt_builder_create(bdpt_context* context, bdpt_builder** builder) {
  return guard(__func__, [&] {
    reset_output(builder);
    require(context, "context");
    require(builder, "builder");
    *builder = new bdpt_builder(context, next_builder_tag.fetch_add(1, std::memory_order_relaxed));
  });
}

void bdpt_builder_destroy(bdpt_builder* builder) {
  if (!builder) return;
  // To free what a call in progress works on would be worse than to leave it to its owner.
  if (builder->busy.is_set())
    return set_last_error(__func__, "the builder is in use by the call that runs this callback");
  delete builder;
}
