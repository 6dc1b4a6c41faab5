// A file that appears whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

namespace bdpt {

// Writes under a temporary name beside the target and renames at commit, so that the path holds the old file or the
// new one, never half of either. Failures throw ErrorCode::Io with the path and the system's reason; without a commit
// the destructor removes what was written. A symbolic link is followed; what is no regular file is refused.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* data, size_t size);
  uint64_t position();
  void seek(uint64_t position);
  // Fails, too, when an earlier write or seek failed, even if its exception was swallowed on the way.
  void commit();
  // Throws the first failure again, if there was one.
  void check() const;

 private:
  [[noreturn]] void failed(int error);

  std::string path_;    // as the caller named it, for error texts
  std::string target_;  // with symbolic links followed
  std::string temporary_;
  std::FILE* file_ = nullptr;
  int error_ = 0;  // errno of the first failure
};

}  // namespace bdpt
