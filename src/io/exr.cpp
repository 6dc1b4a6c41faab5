#include "io/exr.h"

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <new>
#include <set>

#include "base/error.h"
#include "io/atomic_file.h"

namespace bdpt {
namespace {

constexpr uint32_t kMaxChannelName = 255;  // of the file format
constexpr float kHalfMax = HALF_MAX;
constexpr uint32_t kRowsAtOnce = 16;  // one ZIP block

class FileStream : public Imf::OStream {
 public:
  FileStream(AtomicFile& file, const std::string& path) : Imf::OStream(path.c_str()), file_(file) {}
  void write(const char data[], int size) override { file_.write(data, static_cast<size_t>(size)); }
  uint64_t tellp() override { return file_.position(); }
  void seekp(uint64_t position) override { file_.seek(position); }

 private:
  AtomicFile& file_;
};

// The three channels of a layer.
std::array<std::string, 3> channel_names(const std::string& layer) {
  const std::string prefix = layer.empty() ? "" : layer + ".";
  return {prefix + "R", prefix + "G", prefix + "B"};
}

void check_arguments(uint32_t width, uint32_t height, const std::vector<ExrLayer>& layers) {
  if (width < 1 || height < 1 || width > INT_MAX || height > INT_MAX)
    fail(ErrorCode::InvalidArgument, "an image of ", width, " x ", height, " pixels cannot be written as OpenEXR");
  if (layers.empty()) fail(ErrorCode::InvalidArgument, "an OpenEXR file needs at least one layer");
  std::set<std::string> names;
  for (const ExrLayer& layer : layers) {
    if (!layer.pixels) fail(ErrorCode::InvalidArgument, "layer '", layer.name, "' has no pixels");
    if (layer.name.size() + 2 > kMaxChannelName)
      fail(ErrorCode::InvalidArgument, "layer name '", layer.name, "' is longer than ", kMaxChannelName - 2, " bytes");
    if (!names.insert(layer.name).second) fail(ErrorCode::InvalidArgument, "two layers are named '", layer.name, "'");
  }
}

Imf::Chromaticities to_imf(const ExrChromaticities& c) {
  const auto xy = [&](size_t i) { return Imath::V2f(c[i][0], c[i][1]); };
  return {xy(0), xy(1), xy(2), xy(3)};
}

half to_half(float value) { return std::isfinite(value) ? half(std::clamp(value, -kHalfMax, kHalfMax)) : half(value); }

void write_rows(Imf::OutputFile& output, uint32_t width, uint32_t height, const std::vector<ExrLayer>& layers,
                bool as_half) {
  const Imf::PixelType type = as_half ? Imf::HALF : Imf::FLOAT;
  const size_t channel_size = as_half ? sizeof(half) : sizeof(float);
  const size_t row = size_t{3} * width;
  std::vector<half> halves(as_half ? row * kRowsAtOnce * layers.size() : 0);

  for (uint32_t y = 0; y < height; y += kRowsAtOnce) {
    const uint32_t rows = std::min(kRowsAtOnce, height - y);
    Imf::FrameBuffer buffer;
    for (size_t i = 0; i < layers.size(); ++i) {
      const float* source = layers[i].pixels + row * y;
      const char* data = reinterpret_cast<const char*>(source);
      if (as_half) {
        half* converted = halves.data() + row * kRowsAtOnce * i;
        std::transform(source, source + row * rows, converted, to_half);
        data = reinterpret_cast<const char*>(converted);
      }
      for (const std::string& name : channel_names(layers[i].name)) {
        buffer.insert(name, Imf::Slice::Make(type, data, Imath::V2i(0, static_cast<int>(y)), width, rows,
                                             3 * channel_size, row * channel_size));
        data += channel_size;
      }
    }
    output.setFrameBuffer(buffer);
    output.writePixels(static_cast<int>(rows));
  }
}

}  // namespace

void write_exr(const std::string& path, uint32_t width, uint32_t height, const std::vector<ExrLayer>& layers,
               bool as_half, const ExrChromaticities& chromaticities) {
  check_arguments(width, height, layers);
  AtomicFile file(path);
  try {
    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, to_imf(chromaticities));
    for (const ExrLayer& layer : layers)
      for (const std::string& name : channel_names(layer.name))
        header.channels().insert(name, Imf::Channel(as_half ? Imf::HALF : Imf::FLOAT));

    FileStream stream(file, path);
    Imf::OutputFile output(stream, header, 0);
    write_rows(output, width, height, layers, as_half);
    // The destructor writes the table of scanlines, and swallows its errors; commit tells them.
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    file.check();  // the reason, if it was the file
    fail(ErrorCode::Io, "cannot write '", path, "': ", error.what());
  }
  file.commit();
}

}  // namespace bdpt
