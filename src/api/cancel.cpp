#include "api/handles.h"

using namespace bdpt;

bdpt_result bdpt_cancel_create(bdpt_cancel** cancel) {
  return guard(__func__, [&] {
    require(cancel, "cancel") = nullptr;
    *cancel = new bdpt_cancel;
  });
}

void bdpt_cancel_retain(bdpt_cancel* cancel) {
  if (cancel) cancel->retain();
}

void bdpt_cancel_release(bdpt_cancel* cancel) {
  if (cancel) cancel->release();
}

void bdpt_cancel_request(bdpt_cancel* cancel) {
  if (cancel) cancel->requested.store(true, std::memory_order_relaxed);
}

void bdpt_cancel_reset(bdpt_cancel* cancel) {
  if (cancel) cancel->requested.store(false, std::memory_order_relaxed);
}

uint32_t bdpt_cancel_is_requested(const bdpt_cancel* cancel) {
  return cancel && cancel->requested.load(std::memory_order_relaxed) ? 1 : 0;
}
