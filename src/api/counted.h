// Handles with a count of references.
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

namespace bdpt {

// Base of a handle struct; a new one has one reference.
template <class T>
class Counted {
 public:
  void retain() const noexcept { references_.fetch_add(1, std::memory_order_relaxed); }
  void release() const noexcept {
    if (references_.fetch_sub(1, std::memory_order_acq_rel) == 1) delete static_cast<const T*>(this);
  }

 protected:
  Counted() = default;
  ~Counted() = default;
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  mutable std::atomic<uint64_t> references_{1};
};

// One reference, held by the library itself.
template <class T>
class Ref {
 public:
  Ref() = default;
  explicit Ref(T* handle) : handle_(handle) {
    if (handle_) handle_->retain();
  }
  Ref(const Ref& o) : Ref(o.handle_) {}
  Ref(Ref&& o) noexcept : handle_(std::exchange(o.handle_, nullptr)) {}
  Ref& operator=(Ref o) noexcept {
    std::swap(handle_, o.handle_);
    return *this;
  }
  ~Ref() {
    if (handle_) handle_->release();
  }
  T* get() const { return handle_; }
  T* operator->() const { return handle_; }
  T& operator*() const { return *handle_; }
  explicit operator bool() const { return handle_ != nullptr; }

 private:
  T* handle_ = nullptr;
};

}  // namespace bdpt
