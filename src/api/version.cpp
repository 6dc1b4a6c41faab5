#include "bdpt.h"

uint32_t bdpt_version(void) { return BDPT_VERSION_MAJOR << 16 | BDPT_VERSION_MINOR << 8 | BDPT_VERSION_PATCH; }

uint32_t bdpt_abi_version(void) { return BDPT_ABI; }
