// What `bdpt render` writes beside the picture: --outputs and --denoise.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "handles.h"
#include "image.h"
#include "scene_description.h"

namespace bdpt_tool {

extern const char kOutputsHelp[];

class RenderOutputs {
 public:
  // Names by commas, as in the help; `denoise`: what the denoiser needs, too. An Error of kUsage.
  RenderOutputs(const std::string& names, bool denoise);

  bool any() const { return !descs_.empty() || samples_; }
  // The camera's, which stand as long as this does.
  void add_to(bdpt_camera_desc& camera) const;
  // The denoised picture; an empty image without --denoise.
  Image denoised(const bdpt_film* film, bool partial, std::uint32_t threads) const;
  // The picture, its variance, and all that was asked for, in one file. `denoised`, unless empty, takes the picture's
  // place, which is then the layer 'noisy'. Tells on stderr what mattes leave out.
  void write(const std::string& path, const bdpt_film* film, bool partial, const bdpt_context* context,
             const SceneDescription& scene, const Image& denoised) const;

 private:
  struct Output {
    std::string layer;                  // of the file; empty = none of its own
    std::vector<std::string> channels;  // as many as are written
    std::uint32_t number;               // plane, or coverage
    bdpt_output_kind kind;
  };
  void add(const std::string& name);
  std::uint32_t add_plane(bdpt_output_kind kind, bdpt_light_paths paths = BDPT_LIGHT_PATHS_ALL,
                          std::uint64_t groups = 0, bool unfiltered = false);

  std::vector<bdpt_output_desc> descs_;
  std::vector<Output> outputs_;
  std::uint32_t planes_ = 1, coverages_ = 0;
  std::uint32_t color_ = 0, albedo_ = 0, normal_ = 0;  // planes for the denoiser
  bool samples_ = false, denoise_ = false;
};

}  // namespace bdpt_tool
