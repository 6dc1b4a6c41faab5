// What a description owes for the arrays that it brings.
#pragma once

#include "api/desc.h"
#include "api/host_calls.h"

#include <array>

namespace bdpt {

inline FinalCall final_call(const bdpt_data& data) { return {data.release, data.user, data.data}; }

// The releases of a description's arrays, all of which are copied. They are owed from the moment it can be read, so
// also when it is then refused; of a struct whose size is that of no version, nothing can be read and nothing is
// called.
template <class Desc, bdpt_data Desc::*... arrays>
class Releases {
 public:
  explicit Releases(const Desc* desc) : Releases(is_readable(desc) ? copy_readable(*desc) : Desc{}) {}

 private:
  explicit Releases(const Desc& desc) : calls_{final_call(desc.*arrays)...} {}
  std::array<FinalCall, sizeof...(arrays)> calls_;
};

}  // namespace bdpt
