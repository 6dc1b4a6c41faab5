// How many bytes a context uses, against the limit its host set.
#pragma once

#include "base/error.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace bdpt {

class MemoryMeter {
 public:
  explicit MemoryMeter(uint64_t limit) : limit_(limit) {}
  // Books bytes, or throws Error(MemoryLimit) and books nothing.
  void add(uint64_t bytes, const char* what) {
    if (!try_add(bytes))
      fail(ErrorCode::MemoryLimit, what, " needs ", bytes, " bytes; ", used_.load(),
           " of the context's memory_limit of ", limit_, " are in use");
  }
  bool try_add(uint64_t bytes) {
    const uint64_t now = used_.fetch_add(bytes) + bytes;
    if (limit_ != 0 && now > limit_) {
      used_.fetch_sub(bytes);
      return false;
    }
    raise_peak(now);
    return true;
  }
  // Books what is there already, beyond the limit, too.
  void add_always(uint64_t bytes) {
    const uint64_t now = used_.fetch_add(bytes) + bytes;
    raise_peak(now);
  }
  void subtract(uint64_t bytes) { used_.fetch_sub(bytes); }
  uint64_t used() const { return used_.load(); }
  uint64_t peak() const { return peak_.load(); }
  uint64_t limit() const { return limit_; }

 private:
  void raise_peak(uint64_t now) {
    uint64_t peak = peak_.load();
    while (now > peak && !peak_.compare_exchange_weak(peak, now)) {
    }
  }

  uint64_t limit_;
  std::atomic<uint64_t> used_{0}, peak_{0};
};

// Bytes booked for as long as this lives.
class Booking {
 public:
  Booking() = default;
  Booking(std::shared_ptr<MemoryMeter> meter, uint64_t bytes, const char* what)
      : meter_(std::move(meter)), bytes_(bytes) {
    if (meter_) meter_->add(bytes_, what);
  }
  Booking(Booking&& o) noexcept : meter_(std::move(o.meter_)), bytes_(o.bytes_) { o.meter_ = nullptr; }
  Booking& operator=(Booking&& o) noexcept {
    std::swap(meter_, o.meter_);
    std::swap(bytes_, o.bytes_);
    return *this;
  }
  ~Booking() {
    if (meter_) meter_->subtract(bytes_);
  }
  uint64_t bytes() const { return bytes_; }

 private:
  std::shared_ptr<MemoryMeter> meter_;
  uint64_t bytes_ = 0;
};

}  // namespace bdpt
