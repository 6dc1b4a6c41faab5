// SPDX-License-Identifier: Apache-2.0
#include "exr_channels.h"

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>

#include "whole_file.h"

namespace bdpt_tool {

void write_exr_channels(const std::string& path, std::uint32_t width, std::uint32_t height,
                        const std::vector<ExrChannel>& channels, const std::map<std::string, std::string>& attributes,
                        const bdpt_chromaticities& chromaticities) {
  Imf::Header header(static_cast<int>(width), static_cast<int>(height));
  header.compression() = Imf::ZIP_COMPRESSION;
  const auto point = [](const float xy[2]) { return Imath::V2f(xy[0], xy[1]); };
  Imf::addChromaticities(header, Imf::Chromaticities(point(chromaticities.red), point(chromaticities.green),
                                                     point(chromaticities.blue), point(chromaticities.white)));
  for (const auto& [name, text] : attributes) header.insert(name, Imf::StringAttribute(text));
  Imf::FrameBuffer buffer;
  for (const ExrChannel& channel : channels) {
    header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
    const std::size_t stride = channel.stride * sizeof(float);
    buffer.insert(channel.name, Imf::Slice::Make(Imf::FLOAT, channel.values, Imath::V2i(0, 0), width, height, stride,
                                                 stride * width));
  }
  write_whole_file(path, [&](std::ofstream& out) {
    Imf::StdOFStream stream(out, path.c_str());
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(buffer);
    file.writePixels(static_cast<int>(height));
  });
}

}  // namespace bdpt_tool
