// Renders until a limit or Ctrl-C, with a progress bar, and saves the film now and then.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "handles.h"
#include "render_options.h"

namespace bdpt_tool {

// The passes of `range` that are not done, and the limits of the options. With --film, the film is saved every
// --checkpoint seconds; not at the end, which is the caller's.
void advance(bdpt_render* render, const bdpt_film* film, const RenderOptions& options, const PassRange& range,
             bdpt_cancel* cancel);

// Writes the file of --film, if that is given. An Error of kOutput if it cannot.
void save_film(const bdpt_film* film, const RenderOptions& options);

}  // namespace bdpt_tool
