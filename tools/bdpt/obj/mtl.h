// MTL files: the materials of OBJ.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "notes.h"
#include "scene_description.h"
#include "scene_folder.h"

namespace bdpt_tool::obj {

struct Line;

// By illum: 3 is a mirror of Ks where there is no Kd, 5 is one always; 4, 6, 7 and 9 are glass of index Ni; all others
// are diffuse of Kd with a gloss of Ks. Ke shines to the front. d and Tr are alpha. Without an illum, as 2.
class MaterialLibrary {
 public:
  MaterialLibrary(SceneDescription& scene, const SceneFolder& folder, Notes& notes)
      : scene_(scene), folder_(folder), notes_(notes) {}

  // Adds the materials of a file; of two with one name the first stays. Textures are sought in the folder of the file.
  void read(const std::string& path, const Location& from);
  // The scene's material; -1 if there is none of this name.
  int find(const std::string& name) const;

 private:
  struct Entry;

  void parse(const std::string& text, const std::string& path);
  void set(const Line& line, Entry& entry);
  void set_map(const Line& line, bool is_color, TextureUse& use);
  void finish(Entry& entry);

  SceneDescription& scene_;
  const SceneFolder& folder_;
  Notes& notes_;
  std::map<std::string, int> materials_;
  std::map<std::pair<std::string, bool>, int> textures_;
  std::string subfolder_;  // of the file, below the scene's folder
};

}  // namespace bdpt_tool::obj
