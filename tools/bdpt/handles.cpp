// SPDX-License-Identifier: Apache-2.0
#include "handles.h"

namespace bdpt_tool {
namespace {

ExitCode exit_code(bdpt_result result) {
  switch (result) {
    case BDPT_ERROR_INVALID_ARGUMENT:
    case BDPT_ERROR_FORMAT:
      return ExitCode::kInput;
    case BDPT_ERROR_IO:
      return ExitCode::kOutput;
    case BDPT_ERROR_MISMATCH:
      return ExitCode::kMismatch;
    default:
      return ExitCode::kFailure;
  }
}

void write_log(void* user, bdpt_log_level level, const char* text) {
  if (level >= BDPT_LOG_WARNING) static_cast<Diagnostics*>(user)->warn(text);
}

}  // namespace

bdpt_result check(bdpt_result result, const std::string& what) {
  if (result >= 0) return result;
  throw Error(exit_code(result), what + ": " + bdpt_last_error() + " (" + bdpt_result_name(result) + ")");
}

bdpt_result check(bdpt_result result, const Location& where) {
  if (result == BDPT_ERROR_INVALID_ARGUMENT) throw Error(where, bdpt_last_error());
  return check(result, where.prefix() + "the scene");
}

Context make_context(std::uint32_t threads, Diagnostics& diagnostics, const ColorOptions& color) {
  auto log = sized<bdpt_log>();
  log.write = write_log;
  log.user = &diagnostics;
  auto desc = sized<bdpt_context_desc>();
  desc.threads = threads;
  desc.log = &log;
  if (!color.config.empty()) desc.color_config = color.config.c_str();
  if (!color.working_space.empty()) desc.rendering_space = color.working_space.c_str();
  bdpt_context* context = nullptr;
  const bdpt_result result = bdpt_context_create(BDPT_ABI, &desc, &context);
  const bool is_colored = desc.color_config || desc.rendering_space;
  if (is_colored && result != BDPT_ERROR_OUT_OF_MEMORY && result < 0) throw Error(ExitCode::kInput, bdpt_last_error());
  check(result, "cannot start the library");
  return Context(context);
}

bdpt_film_info film_info(const bdpt_film* film) {
  auto info = sized<bdpt_film_info>();
  check(bdpt_film_get_info(film, &info), "the film");
  return info;
}

}  // namespace bdpt_tool
