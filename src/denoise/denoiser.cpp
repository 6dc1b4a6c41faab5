#include "denoise/denoiser.h"

#include "base/error.h"

#include <dlfcn.h>

#include <cstddef>
#include <memory>
#include <string>

namespace bdpt {

namespace {

// Of its C interface, which versions 1.4 to 2 share but for the names of setters.
constexpr int kCpu = 1, kFloat3 = 3;

struct Library {
  void* (*new_device)(int) = nullptr;
  void (*set_device_bool)(void*, const char*, bool) = nullptr;
  void (*set_device_int)(void*, const char*, int) = nullptr;
  void (*commit_device)(void*) = nullptr;
  int (*device_error)(void*, const char**) = nullptr;
  void (*release_device)(void*) = nullptr;
  void* (*new_filter)(void*, const char*) = nullptr;
  void (*set_image)(void*, const char*, void*, int, size_t, size_t, size_t, size_t, size_t) = nullptr;
  void (*set_bool)(void*, const char*, bool) = nullptr;
  void (*commit_filter)(void*) = nullptr;
  void (*execute)(void*) = nullptr;
  void (*release_filter)(void*) = nullptr;
  std::string missing;  // why it cannot be used; empty where it can

  Library() {
    void* handle = nullptr;
    for (const char* name :
         {"libOpenImageDenoise.so.2", "libOpenImageDenoise.so.1", "libOpenImageDenoise.so.0", "libOpenImageDenoise.so"})
      if (!handle) handle = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (!handle) {
      missing = "is not there: install Open Image Denoise (libOpenImageDenoise.so), or do without";
      return;
    }
    find(handle, new_device, "oidnNewDevice");
    find(handle, set_device_bool, "oidnSetDeviceBool", "oidnSetDevice1b");
    find(handle, set_device_int, "oidnSetDeviceInt", "oidnSetDevice1i");
    find(handle, commit_device, "oidnCommitDevice");
    find(handle, device_error, "oidnGetDeviceError");
    find(handle, release_device, "oidnReleaseDevice");
    find(handle, new_filter, "oidnNewFilter");
    find(handle, set_image, "oidnSetSharedFilterImage");
    find(handle, set_bool, "oidnSetFilterBool", "oidnSetFilter1b");
    find(handle, commit_filter, "oidnCommitFilter");
    find(handle, execute, "oidnExecuteFilter");
    find(handle, release_filter, "oidnReleaseFilter");
  }

 private:
  template <class Function>
  void find(void* handle, Function*& function, const char* name, const char* old_name = nullptr) {
    void* found = dlsym(handle, name);
    if (!found && old_name) found = dlsym(handle, old_name);
    if (!found && missing.empty()) missing = std::string("has no ") + name + ": install version 1.4 or later";
    function = reinterpret_cast<Function*>(found);
  }
};

// It stays loaded: its threads may outlive a call.
const Library& library() {
  static const Library loaded;
  return loaded;
}

}  // namespace

bool has_denoiser() { return library().missing.empty(); }

void denoise(const DenoiseImages& images, uint32_t threads) {
  const Library& oidn = library();
  if (!oidn.missing.empty()) fail(ErrorCode::Unsupported, "the denoiser ", oidn.missing);
  const std::unique_ptr<void, void (*)(void*)> device(oidn.new_device(kCpu), oidn.release_device);
  const auto check = [&](void* object) {
    const char* message = nullptr;
    if (oidn.device_error(device.get(), &message) != 0 || !object)
      fail(ErrorCode::Internal, "Open Image Denoise: ", message ? message : "it failed without a reason");
  };
  check(device.get());
  oidn.set_device_bool(device.get(), "setAffinity", false);  // the host's threads are left where they are
  if (threads > 0) oidn.set_device_int(device.get(), "numThreads", int(threads));
  oidn.commit_device(device.get());
  check(device.get());
  const std::unique_ptr<void, void (*)(void*)> filter(oidn.new_filter(device.get(), "RT"), oidn.release_filter);
  check(filter.get());
  const auto set = [&](const char* name, const float* pixels) {
    if (pixels)
      oidn.set_image(filter.get(), name, const_cast<float*>(pixels), kFloat3, images.width, images.height, 0, 0, 0);
  };
  set("color", images.color);
  set("albedo", images.albedo);
  set("normal", images.normal);
  set("output", images.output);
  oidn.set_bool(filter.get(), "hdr", true);
  if (images.albedo) oidn.set_bool(filter.get(), "cleanAux", images.clean);
  oidn.commit_filter(filter.get());
  oidn.execute(filter.get());
  check(filter.get());
}

}  // namespace bdpt
