#include "io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/error.h"

namespace bdpt {
namespace {

[[noreturn]] void fail_io(const std::string& path, int error) {
  fail(ErrorCode::Io, "cannot write '", path, "': ", std::generic_category().message(error));
}

// Where the file will be: behind the symbolic link, if path is one that leads somewhere.
std::string follow_link(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return path;
  const std::filesystem::path target = std::filesystem::canonical(path, error);
  return error ? path : target.string();
}

// A name in the target's folder that does not depend on the target's, whose length may be the longest allowed.
std::string temporary_name(const std::string& target) {
  static std::atomic<uint64_t> counter{0};
  const std::string name = ".bdpt-" + std::to_string(getpid()) + "-" + std::to_string(counter++) + ".tmp";
  return target.substr(0, target.rfind('/') + 1) + name;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(follow_link(path)) {
  if (path.empty()) fail(ErrorCode::Io, "cannot write a file without a name: the path is empty");
  struct stat status;
  if (stat(target_.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) fail_io(path_, EISDIR);
    if (!S_ISREG(status.st_mode)) fail(ErrorCode::Io, "cannot write '", path_, "': it is no regular file");
    // The rename would ask the folder only; a file that was made read-only stays as it is.
    if (access(target_.c_str(), W_OK) != 0) fail_io(path_, errno);
  } else if (target_.back() == '/') {
    fail_io(path_, EISDIR);
  }

  int descriptor = -1;
  do {
    temporary_ = temporary_name(target_);
    descriptor = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor < 0 && errno == EEXIST);
  if (descriptor < 0) fail_io(path_, errno);
  file_ = fdopen(descriptor, "wb");
  if (!file_) {
    const int error = errno;
    close(descriptor);
    unlink(temporary_.c_str());
    fail_io(path_, error);
  }
}

AtomicFile::~AtomicFile() {
  if (file_) {
    std::fclose(file_);
    unlink(temporary_.c_str());
  }
}

void AtomicFile::failed(int error) {
  if (!error_) error_ = error ? error : EIO;
  fail_io(path_, error_);
}

void AtomicFile::check() const {
  if (error_) fail_io(path_, error_);
}

void AtomicFile::write(const void* data, size_t size) {
  check();
  if (size > 0 && std::fwrite(data, 1, size, file_) != size) failed(errno);
}

uint64_t AtomicFile::position() {
  const off_t position = ftello(file_);
  if (position < 0) failed(errno);
  return static_cast<uint64_t>(position);
}

void AtomicFile::seek(uint64_t position) {
  if (fseeko(file_, static_cast<off_t>(position), SEEK_SET) != 0) failed(errno);
}

void AtomicFile::commit() {
  check();
  if (std::fflush(file_) != 0) failed(errno);
  // Some network file systems tell of a full disk only here.
  const int closed = std::fclose(file_);
  const int error = errno;
  file_ = nullptr;
  if (closed != 0 || std::rename(temporary_.c_str(), target_.c_str()) != 0) {
    const int reason = closed != 0 ? error : errno;
    unlink(temporary_.c_str());
    failed(reason);
  }
}

}  // namespace bdpt
