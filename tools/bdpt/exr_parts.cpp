// SPDX-License-Identifier: Apache-2.0
#include "exr_parts.h"

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>

#include "whole_file.h"

namespace bdpt_tool {
namespace {

constexpr const char* kChannels[3] = {"R", "G", "B"};

std::string prefix(const std::string& layer) { return layer.empty() ? "" : layer + "."; }

Imf::Header header_of(const std::string& part, const Image& image, const std::vector<std::string>& layers) {
  Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  header.setName(part);
  header.setType(Imf::SCANLINEIMAGE);
  Imf::addChromaticities(header, Imf::Chromaticities());  // Rec. 709, its default
  for (const char* channel : kChannels) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  for (const std::string& layer : layers)
    for (const char* channel : kChannels) header.channels().insert(prefix(layer) + channel, Imf::Channel(Imf::FLOAT));
  return header;
}

void add_slices(Imf::FrameBuffer& buffer, const std::string& layer, const Image& image) {
  for (std::size_t c = 0; c < 3; ++c)
    buffer.insert(prefix(layer) + kChannels[c],
                  Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, Imath::V2i(0, 0), image.width, image.height,
                                   3 * sizeof(float), 3 * sizeof(float) * image.width));
}

}  // namespace

void write_exr_parts(const std::string& path, const std::vector<std::string>& parts,
                     const std::vector<std::string>& layers,
                     const std::function<std::vector<Image>(std::size_t part)>& images) {
  std::vector<Image> planes = images(0);
  std::vector<Imf::Header> headers;
  for (const std::string& part : parts) headers.push_back(header_of(part, planes[0], layers));
  write_whole_file(path, [&](std::ofstream& out) {
    Imf::StdOFStream stream(out, path.c_str());
    Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()));
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i > 0) planes = images(i);
      Imf::FrameBuffer buffer;
      add_slices(buffer, "", planes[0]);
      for (std::size_t layer = 0; layer < layers.size(); ++layer) add_slices(buffer, layers[layer], planes[layer]);
      Imf::OutputPart part(file, static_cast<int>(i));
      part.setFrameBuffer(buffer);
      part.writePixels(static_cast<int>(planes[0].height));
    }
    // The destructor writes the tables of scanlines, and swallows its errors; the stream keeps them.
  });
}

}  // namespace bdpt_tool
