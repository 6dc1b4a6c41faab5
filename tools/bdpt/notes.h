// What a reader leaves out or changes, told once for each kind.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "error.h"

namespace bdpt_tool {

class Notes {
 public:
  Notes(std::string path, Diagnostics& diagnostics) : where_{std::move(path), 0}, diagnostics_(diagnostics) {}

  // `text` says what, `place` which thing of the file, in the reader's words; call it once for each thing.
  void add(const std::string& text, const std::string& place = {});
  // Warns of each text, with its first place and how many more there are.
  void tell();

 private:
  struct Note {
    std::string text, first_place;
    std::size_t places = 0;
  };

  Location where_;
  Diagnostics& diagnostics_;
  std::vector<Note> notes_;
};

}  // namespace bdpt_tool
