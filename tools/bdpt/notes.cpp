// SPDX-License-Identifier: Apache-2.0
#include "notes.h"

#include <algorithm>

namespace bdpt_tool {

void Notes::add(const std::string& text, const std::string& place) {
  auto note = std::find_if(notes_.begin(), notes_.end(), [&](const Note& n) { return n.text == text; });
  if (note == notes_.end()) note = notes_.insert(note, {text, place, 0});
  ++note->places;
}

void Notes::tell() {
  for (const Note& note : notes_) {
    std::string text = note.text;
    if (!note.first_place.empty()) text += ": " + note.first_place;
    if (!note.first_place.empty() && note.places > 1) text += " and " + std::to_string(note.places - 1) + " more";
    diagnostics_.warn(where_, text);
  }
  notes_.clear();
}

}  // namespace bdpt_tool
