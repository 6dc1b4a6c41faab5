// SPDX-License-Identifier: Apache-2.0
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>

#include <filesystem>

#include "image.h"
#include "image_chromaticities.h"

namespace bdpt_tool {
namespace {

// The names of the layers, without the dot: "" for the main one.
std::vector<std::string> layers_of(const Imf::ChannelList& channels) {
  std::vector<std::string> layers;
  for (auto it = channels.begin(); it != channels.end(); ++it) {
    const std::string name = it.name();
    if (name != "R" && !name.ends_with(".R")) continue;
    const std::string layer = name.substr(0, name.size() == 1 ? 0 : name.size() - 2);
    const std::string prefix = layer.empty() ? "" : layer + ".";
    if (channels.findChannel(prefix + "G") && channels.findChannel(prefix + "B")) layers.push_back(layer);
  }
  return layers;
}

void add_slices(Imf::FrameBuffer& buffer, const std::string& layer, Image& image, const Imath::Box2i& window) {
  const std::string prefix = layer.empty() ? "" : layer + ".";
  const std::size_t pixel = 3 * sizeof(float), row = pixel * image.width;
  const char* names[3] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    // OpenEXR wants the address pixel (0, 0) would have.
    char* base = reinterpret_cast<char*>(image.pixels.data() + c) -
                 (static_cast<std::ptrdiff_t>(window.min.x) * static_cast<std::ptrdiff_t>(pixel) +
                  static_cast<std::ptrdiff_t>(window.min.y) * static_cast<std::ptrdiff_t>(row));
    buffer.insert(prefix + names[c], Imf::Slice(Imf::FLOAT, base, pixel, row));
  }
}

std::map<std::string, Image> read(Imf::MultiPartInputFile& parts, int part, std::size_t file_size) {
  const Imath::Box2i window = parts.header(part).dataWindow();
  const auto width = static_cast<std::uint32_t>(std::int64_t{window.max.x} - window.min.x + 1);
  const auto height = static_cast<std::uint32_t>(std::int64_t{window.max.y} - window.min.y + 1);
  // The codes of some black pictures are denser than deflate: one byte to a pixel is asked for.
  if (const char* fault = detail::size_fault(width, height, 1, file_size)) {
    throw std::runtime_error(fault);
  }
  Imf::InputPart file(parts, part);
  std::map<std::string, Image> images;
  Imf::FrameBuffer buffer;
  for (const std::string& layer : layers_of(file.header().channels())) {
    const auto added = images.emplace(layer, Image(width, height)).first;
    add_slices(buffer, layer, added->second, window);
  }
  if (images.empty()) throw std::runtime_error("no channels R, G and B");
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  detail::convert_to_rec709(file.header(), images);
  return images;
}

}  // namespace

std::map<std::string, Image> read_exr(const std::string& path, const Location& from) {
  try {
    Imf::MultiPartInputFile file(path.c_str());
    return read(file, 0, std::filesystem::file_size(path));
  } catch (const std::exception& error) {
    detail::fail_image(path, from, error.what());
  }
}

std::map<std::string, std::map<std::string, Image>> read_exr_parts(const std::string& path) {
  try {
    Imf::MultiPartInputFile file(path.c_str());
    std::map<std::string, std::map<std::string, Image>> parts;
    const std::size_t size = std::filesystem::file_size(path);
    for (int i = 0; i < file.parts(); ++i) {
      parts[file.header(i).hasName() ? file.header(i).name() : ""] = read(file, i, size);
    }
    return parts;
  } catch (const std::exception& error) {
    detail::fail_image(path, {}, error.what());
  }
}

}  // namespace bdpt_tool
