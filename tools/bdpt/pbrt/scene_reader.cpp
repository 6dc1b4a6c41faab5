// SPDX-License-Identifier: Apache-2.0
#include "pbrt/scene_reader.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "file_data.h"
#include "pbrt/directives.h"

namespace bdpt_tool {
namespace {

constexpr std::size_t kMaxIncludeDepth = 32, kMaxIncludes = 10000;

class Reader {
 public:
  Reader(const std::string& path, const ReadOptions& options, Diagnostics& diagnostics)
      : path_(path), folder_(path, options.folder), directives_(scene_, diagnostics, folder_) {
    scene_.path = path;
    // A file without a Camera has the format's default one.
    scene_.camera.transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0};
  }

  SceneDescription read() {
    read_file(path_, {});
    directives_.finish({path_, last_line_});
    merge_environments();
    return std::move(scene_);
  }

 private:
  void read_file(const std::string& path, const Location& from) {
    if (++depth_ > kMaxIncludeDepth) {
      throw Error(from, "files include each other more than " + std::to_string(kMaxIncludeDepth) + " deep; does '" +
                            path + "' include itself?");
    }
    if (++files_ > kMaxIncludes) {
      throw Error(from, "more than " + std::to_string(kMaxIncludes) + " files are included; use ObjectInstance");
    }
    if (path.ends_with(".gz")) throw Error(from, "'" + path + "' is compressed; unpack it with gunzip");
    const FileData file(path, from);
    Lexer lexer(file.text(), path);
    while (const std::optional<Token> token = lexer.next()) {
      last_line_ = token->line;
      const Location where = lexer.location(token->line);
      const bool word = token->kind == Token::Kind::kWord;
      if (word && token->text == "Include") {
        read_file(expect_path(lexer, where), where);
      } else if (word && token->text == "Import") {
        directives_.begin_import(where);
        read_file(expect_path(lexer, where), where);
        directives_.end_import(where);
      } else {
        directives_.execute(*token, lexer);
      }
    }
    --depth_;
  }

  // Paths are relative to the folder of the scene's first file.
  std::string expect_path(Lexer& lexer, const Location& where) const {
    return folder_.path_of(expect_string(lexer, where, "a file name"), where);
  }

  // Whether both are one environment; in pbrt each of its windows is a light.
  bool share_environment(const LightDescription& a, const LightDescription& b) const {
    if (a.type != BDPT_LIGHT_ENVIRONMENT || b.type != BDPT_LIGHT_ENVIRONMENT || a.portals.empty() ||
        b.portals.empty() || a.value != b.value || a.transform != b.transform || (a.texture < 0) != (b.texture < 0))
      return false;
    const auto picture = [&](const LightDescription& light) {
      return std::get_if<Image>(&scene_.textures[static_cast<std::size_t>(light.texture)].image);
    };
    if (a.texture < 0) return true;
    const Image *const of_a = picture(a), *const of_b = picture(b);
    return of_a && of_b && of_a->pixels == of_b->pixels;
  }

  // Several infinite lights of one radiance add up, but those that differ by their portal alone.
  void merge_environments() {
    std::vector<LightDescription> lights;
    LightDescription* environment = nullptr;
    lights.reserve(scene_.lights.size());
    for (LightDescription& light : scene_.lights) {
      const auto same = std::find_if(lights.begin(), lights.end(),
                                     [&](const LightDescription& other) { return share_environment(light, other); });
      if (same != lights.end()) {
        same->portals.insert(same->portals.end(), light.portals.begin(), light.portals.end());
        continue;
      }
      if (light.type == BDPT_LIGHT_ENVIRONMENT && light.texture < 0 && environment) {
        for (int c = 0; c < 3; ++c) environment->value[c] += light.value[c];
        environment->portals.insert(environment->portals.end(), light.portals.begin(), light.portals.end());
        continue;
      }
      lights.push_back(std::move(light));
      if (lights.back().type == BDPT_LIGHT_ENVIRONMENT && lights.back().texture < 0) environment = &lights.back();
    }
    scene_.lights = std::move(lights);
  }

  std::string path_;
  SceneFolder folder_;
  SceneDescription scene_;
  Directives directives_;
  std::size_t depth_ = 0, files_ = 0;
  int last_line_ = 0;
};

}  // namespace

SceneDescription read_pbrt_scene(const std::string& path, const ReadOptions& options, Diagnostics& diagnostics) {
  return Reader(path, options, diagnostics).read();
}

}  // namespace bdpt_tool
