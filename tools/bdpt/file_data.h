// A whole file, read only, mapped into memory.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "error.h"

namespace bdpt_tool {

class FileData {
 public:
  // Errors name `from`, the place that asked for the file; without one, the file itself.
  explicit FileData(const std::string& path, const Location& from = {});
  ~FileData();
  FileData(const FileData&) = delete;
  FileData& operator=(const FileData&) = delete;

  std::string_view text() const { return {static_cast<const char*>(data_), size_}; }

 private:
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace bdpt_tool
