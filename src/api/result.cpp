#include "api/result.h"

#include "geometry/embree.h"

#include <cstdio>
#include <cstring>
#include <new>
#include <stdexcept>

namespace bdpt {
namespace {

// A plain array: leaving a text must work without memory, and leave nothing to destroy when a thread ends.
thread_local char last_error[1024];

bdpt_result to_result(ErrorCode code) {
  switch (code) {
    case ErrorCode::InvalidArgument:
      return BDPT_ERROR_INVALID_ARGUMENT;
    case ErrorCode::InvalidId:
      return BDPT_ERROR_INVALID_ID;
    case ErrorCode::OutOfMemory:
      return BDPT_ERROR_OUT_OF_MEMORY;
    case ErrorCode::MemoryLimit:
      return BDPT_ERROR_MEMORY_LIMIT;
    case ErrorCode::Unsupported:
      return BDPT_ERROR_UNSUPPORTED;
    case ErrorCode::Abi:
      return BDPT_ERROR_ABI;
    case ErrorCode::Io:
      return BDPT_ERROR_IO;
    case ErrorCode::Format:
      return BDPT_ERROR_FORMAT;
    case ErrorCode::Mismatch:
      return BDPT_ERROR_MISMATCH;
    case ErrorCode::InUse:
      return BDPT_ERROR_IN_USE;
    case ErrorCode::Reentrant:
      return BDPT_ERROR_REENTRANT;
    case ErrorCode::CallbackFailed:
      return BDPT_ERROR_CALLBACK_FAILED;
    case ErrorCode::Internal:
      return BDPT_ERROR_INTERNAL;
  }
  return BDPT_ERROR_INTERNAL;
}

// A label may be long and in any script: a cut must not leave half a character of UTF-8.
void cut_to_whole_character(char* text, size_t length) {
  while (length > 0 && (static_cast<unsigned char>(text[length - 1]) & 0xC0) == 0x80) --length;
  if (length > 0 && static_cast<unsigned char>(text[length - 1]) >= 0xC0) --length;
  text[length] = 0;
}

}  // namespace

void set_last_error(const char* function, const char* text) noexcept {
  const int length = std::snprintf(last_error, sizeof last_error, "%s: %s", function, text);
  if (length >= static_cast<int>(sizeof last_error)) cut_to_whole_character(last_error, sizeof last_error - 1);
}

bdpt_result result_of_exception(const char* function) noexcept {
  try {
    throw;
  } catch (const Error& error) {
    set_last_error(function, error.what());
    return to_result(error.code());
  } catch (const RayScene::Cancelled&) {
    return BDPT_CANCELLED;
  } catch (const std::bad_alloc&) {
    set_last_error(function, "the system has no memory left");
    return BDPT_ERROR_OUT_OF_MEMORY;
  } catch (const std::length_error&) {  // of a container asked for more than can be addressed
    set_last_error(function, "more memory is needed than can be addressed");
    return BDPT_ERROR_OUT_OF_MEMORY;
  } catch (const std::exception& error) {
    char text[512];
    std::snprintf(text, sizeof text, "a fault of the library, please report it: %s", error.what());
    set_last_error(function, text);
    return BDPT_ERROR_INTERNAL;
  } catch (...) {
    set_last_error(function, "a fault of the library, please report it: an exception of unknown type");
    return BDPT_ERROR_INTERNAL;
  }
}

}  // namespace bdpt

const char* bdpt_last_error(void) { return bdpt::last_error; }

const char* bdpt_result_name(bdpt_result result) {
  switch (result) {
    case BDPT_OK:
      return "BDPT_OK";
    case BDPT_CANCELLED:
      return "BDPT_CANCELLED";
    case BDPT_ERROR_INVALID_ARGUMENT:
      return "BDPT_ERROR_INVALID_ARGUMENT";
    case BDPT_ERROR_INVALID_ID:
      return "BDPT_ERROR_INVALID_ID";
    case BDPT_ERROR_OUT_OF_MEMORY:
      return "BDPT_ERROR_OUT_OF_MEMORY";
    case BDPT_ERROR_MEMORY_LIMIT:
      return "BDPT_ERROR_MEMORY_LIMIT";
    case BDPT_ERROR_UNSUPPORTED:
      return "BDPT_ERROR_UNSUPPORTED";
    case BDPT_ERROR_ABI:
      return "BDPT_ERROR_ABI";
    case BDPT_ERROR_IO:
      return "BDPT_ERROR_IO";
    case BDPT_ERROR_FORMAT:
      return "BDPT_ERROR_FORMAT";
    case BDPT_ERROR_MISMATCH:
      return "BDPT_ERROR_MISMATCH";
    case BDPT_ERROR_IN_USE:
      return "BDPT_ERROR_IN_USE";
    case BDPT_ERROR_REENTRANT:
      return "BDPT_ERROR_REENTRANT";
    case BDPT_ERROR_CALLBACK_FAILED:
      return "BDPT_ERROR_CALLBACK_FAILED";
    case BDPT_ERROR_INTERNAL:
      return "BDPT_ERROR_INTERNAL";
  }
  return "BDPT_ERROR_UNKNOWN";
}
