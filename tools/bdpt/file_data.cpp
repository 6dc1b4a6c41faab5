// SPDX-License-Identifier: Apache-2.0
#include "file_data.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace bdpt_tool {
namespace {

[[noreturn]] void fail(const Location& from, const std::string& path, const char* reason) {
  throw Error(from, "cannot read '" + path + "': " + reason + "; check the file name");
}

class Descriptor {
 public:
  explicit Descriptor(const std::string& path) : fd_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

}  // namespace

FileData::FileData(const std::string& path, const Location& from) {
  Descriptor file(path);
  if (file.get() < 0) fail(from, path, std::strerror(errno));
  struct stat status {};
  if (fstat(file.get(), &status) != 0) fail(from, path, std::strerror(errno));
  if (!S_ISREG(status.st_mode)) fail(from, path, "not a regular file");
  size_ = static_cast<std::size_t>(status.st_size);
  if (size_ == 0) return;
  void* data = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.get(), 0);
  if (data == MAP_FAILED) fail(from, path, std::strerror(errno));
  data_ = data;
}

FileData::~FileData() {
  if (data_) munmap(data_, size_);
}

}  // namespace bdpt_tool
