// The builder's objects of one kind, found by id.
#pragma once

#include "base/error.h"

#include <cstdint>
#include <map>
#include <utility>

namespace bdpt {

enum class IdKind : uint64_t { Shape = 1, Texture, Material, Light, Instance, Medium };

// Ids are 3 bits of kind, 25 of the builder's tag and 36 of a serial number that is never used again, so that an id of
// another kind, of another builder, or of an object that was removed is told for what it is.
struct Id {
  static constexpr int kSerialBits = 36, kTagBits = 25;
  static constexpr uint64_t kSerialMask = (uint64_t(1) << kSerialBits) - 1, kTagMask = (uint64_t(1) << kTagBits) - 1;

  static uint64_t pack(IdKind kind, uint64_t tag, uint64_t serial) {
    return uint64_t(kind) << (kSerialBits + kTagBits) | (tag & kTagMask) << kSerialBits | serial;
  }
  static uint64_t kind(uint64_t id) { return id >> (kSerialBits + kTagBits); }
  static uint64_t tag(uint64_t id) { return id >> kSerialBits & kTagMask; }
};

template <class Entry>
class Table {
 public:
  Table(IdKind kind, const char* kind_name, uint64_t tag)
      : kind_(kind), kind_name_(kind_name), tag_(tag & Id::kTagMask) {}

  uint64_t add(Entry entry) {
    if (next_ > Id::kSerialMask) fail(ErrorCode::OutOfMemory, "the builder has no ids left: start a new builder");
    const uint64_t id = Id::pack(kind_, tag_, next_);
    entries_.emplace_hint(entries_.end(), id, std::move(entry));
    ++next_;
    return id;
  }
  // Throws InvalidId; field says where the id was given.
  Entry& at(uint64_t id, const char* field) {
    const auto found = entries_.find(id);
    if (found == entries_.end()) refuse(id, field);
    return found->second;
  }
  // The entry, which must be there.
  const Entry& operator[](uint64_t id) const { return entries_.find(id)->second; }
  Entry& operator[](uint64_t id) { return entries_.find(id)->second; }
  // Takes an entry out, so that what it holds ends when the table is whole again.
  Entry take(uint64_t id) { return std::move(entries_.extract(id).mapped()); }

  bool empty() const { return entries_.empty(); }
  size_t size() const { return entries_.size(); }
  auto begin() const { return entries_.begin(); }  // in the order of adding
  auto end() const { return entries_.end(); }

 private:
  [[noreturn]] void refuse(uint64_t id, const char* field) const {
    const char* why = " was removed or never given out: pass the id of a living ";
    if (id == 0)
      why = " is zero, which is no id: pass the id of the ";
    else if (Id::kind(id) != uint64_t(kind_))
      why = " is an id of something else: pass the id of the ";
    else if (Id::tag(id) != tag_)
      why = " is an id of another builder: pass this builder's id of the ";
    fail(ErrorCode::InvalidId, field, " (", id, ")", why, kind_name_);
  }

  IdKind kind_;
  const char* kind_name_;
  uint64_t tag_;
  uint64_t next_ = 1;
  std::map<uint64_t, Entry> entries_;
};

}  // namespace bdpt
