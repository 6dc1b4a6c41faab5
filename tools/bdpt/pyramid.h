// The pictures of single techniques, laid out as in Veach (1997), figure 10.4.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "film_output.h"
#include "technique_mask.h"

namespace bdpt_tool {

// The pictures of all techniques of the film that `mask` allows on one sheet, at most max_width pixels wide, linear: a
// row for each number k of edges, ordered by s. Row k is over-exposed by k - 1 stops where `expose_rows`. Without
// `with_t0` the techniques t = 0, which a pinhole cannot serve, are left out.
Image pyramid_sheet(const bdpt_film* film, const TechniqueMask& mask, bool with_t0, bool partial, bool expose_rows,
                    std::uint32_t max_width);

// Writes s<S>t<T>.exr and .png for each technique of the film that `mask` allows, and their sheet as pyramid.png. Row k
// is over-exposed by k - 1 stops.
void write_pyramid(const std::string& folder, const bdpt_film* film, const TechniqueMask& mask, bool with_t0,
                   bool partial, const ViewOptions& options);

}  // namespace bdpt_tool
