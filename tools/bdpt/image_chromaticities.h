// The colours of OpenEXR files.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ImfHeader.h>

#include <map>
#include <string>

#include "image.h"

namespace bdpt_tool::detail {

// Turns the main layer of a file to linear Rec. 709, if its header names other chromaticities. Its variance, which no
// matrix converts, is then left out; other layers stay as they are, for they need not be colours.
void convert_to_rec709(const Imf::Header& header, std::map<std::string, Image>& layers);

}  // namespace bdpt_tool::detail
