// SPDX-License-Identifier: Apache-2.0
#include "progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace bdpt_tool {
namespace {

constexpr std::size_t kBarWidth = 30;

std::string format_seconds(double seconds) {
  char text[32];
  const auto whole = static_cast<long long>(std::min(seconds, 1e9) + 0.5);
  if (whole < 3600) {
    std::snprintf(text, sizeof text, "%lld:%02lld", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
  }
  return text;
}

std::string format_rate(double rate) {
  char text[32];
  if (rate >= 1e6) {
    std::snprintf(text, sizeof text, "%.2f M", rate / 1e6);
  } else {
    std::snprintf(text, sizeof text, "%.1f k", rate / 1e3);
  }
  return text;
}

}  // namespace

ProgressBar::ProgressBar() : terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
  if (drawn_ > 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(drawn_), "");
}

std::int32_t ProgressBar::callback(void* user, const bdpt_progress* progress) {
  auto* bar = static_cast<ProgressBar*>(user);
  if (bar->terminal_) bar->draw(*progress);
  return 0;
}

void ProgressBar::draw(const bdpt_progress& progress) {
  const auto filled = static_cast<std::size_t>(progress.fraction * kBarWidth);
  std::string line = "[";
  line.append(filled, '#').append(kBarWidth - std::min(filled, kBarWidth), '.').append("] ");
  char text[96];
  std::snprintf(text, sizeof text, "%5.1f%%  pass %llu", 100 * progress.fraction,
                static_cast<unsigned long long>(progress.passes));
  line += text;
  if (progress.seconds > 0)
    line.append("  ").append(format_rate(static_cast<double>(progress.samples) / progress.seconds)).append("samples/s");
  if (progress.fraction > 0) {
    line.append("  ")
        .append(format_seconds(progress.seconds * (1 - progress.fraction) / progress.fraction))
        .append(" left");
  }
  const std::size_t width = line.size();
  if (width < drawn_) line += std::string(drawn_ - width, ' ');
  drawn_ = width;
  std::fprintf(stderr, "\r%s", line.c_str());
  std::fflush(stderr);
}

}  // namespace bdpt_tool
