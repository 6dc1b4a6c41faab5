// Errors and warnings of the program, with the place in a scene file they come from.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>

namespace bdpt_tool {

enum class ExitCode : int {
  kSuccess = 0,
  kFailure = 1,       // out of memory, or a fault of the library
  kUsage = 2,         // the command line
  kInput = 3,         // a scene, mesh, texture, film or image is missing, damaged or not understood
  kOutput = 4,        // an output file cannot be written
  kMismatch = 5,      // films or images that do not fit each other
  kInterrupted = 130  // Ctrl-C: what was finished has been written
};

// The exit codes, as --help prints them.
extern const char kExitCodeHelp[];

struct Location {
  std::string file;
  int line = 0;  // 0 = the file as a whole

  // "file:line: " or "file: ", empty without a file.
  std::string prefix() const;
};

// What went wrong and what to do, in one line; the message begins with the location.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& text) : std::runtime_error(text), code_(code) {}
  Error(const Location& where, const std::string& text)
      : std::runtime_error(where.prefix() + text), code_(ExitCode::kInput) {}

  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

// Prints warnings to stderr, each text once, and counts them. Any thread.
class Diagnostics {
 public:
  explicit Diagnostics(bool print = true) : print_(print) {}

  void warn(const std::string& text);
  void warn(const Location& where, const std::string& text) { warn(where.prefix() + text); }

  std::size_t count() const;
  std::set<std::string> texts() const;

 private:
  mutable std::mutex mutex_;
  std::set<std::string> texts_;
  bool print_;
};

}  // namespace bdpt_tool
