#include "api/builder.h"
#include "api/check.h"
#include "api/desc.h"
#include "color/standard_spaces.h"

#include <Imath/half.h>

using namespace bdpt;

namespace {

constexpr uint32_t kMaxLevels = 17;
constexpr uint64_t kMaxRowStride = uint64_t(1) << 32;

// A texture with its place in the memory booked.
struct BookedTexture {
  BookedTexture(Booking booking_, Texture texture_) : booking(std::move(booking_)), texture(std::move(texture_)) {}
  Booking booking;
  Texture texture;
};

class TextureReader {
 public:
  TextureReader(const bdpt_texture_desc& desc, const bdpt_context& context)
      : subject_("texture", desc.label), desc_(desc), context_(context) {
    subject_.check_range("channels", desc.channels, 1, 4);
    subject_.check_range("width", desc.width, 1, kMaxImageSide);
    subject_.check_range("height", desc.height, 1, kMaxImageSide);
    subject_.check_enum("texel", desc.texel, BDPT_TEXEL_HALF);
    subject_.check_enum("encoding", desc.encoding, BDPT_ENCODING_LINEAR);
    subject_.check_range("mip_levels", desc.mip_levels, 0, kMaxLevels);
    subject_.check_reserved("reserved", desc.reserved);
    if (desc.color_space && desc.encoding != BDPT_ENCODING_SRGB)
      subject_.refuse("encoding", "is ", desc.encoding, " although color_space is given, which says it: leave it 0");
    if (!desc.pixels) subject_.refuse("pixels", "is NULL: pass the texels");
    check_layout();
  }

  TextureEntry read(const std::shared_ptr<MemoryMeter>& meter) const {
    Booking booking(meter, kept_size(), subject_.name().c_str());
    TextureEntry entry;
    TextureImage texels;
    if (is_converted()) {
      texels = converted_image(entry.maximum);
    } else {
      entry.maximum = is_real() ? check_values() : 1;
      texels = image();
    }
    auto booked = std::make_shared<const BookedTexture>(std::move(booking), Texture(std::move(texels), levels()));
    entry.texture = std::shared_ptr<const Texture>(booked, &booked->texture);
    return entry;
  }

 private:
  bool is_real() const { return desc_.texel == BDPT_TEXEL_FLOAT || desc_.texel == BDPT_TEXEL_HALF; }
  bool is_srgb() const { return desc_.encoding == BDPT_ENCODING_SRGB; }
  TexelFormat format() const;
  // Grey of the sRGB curve needs no conversion: white is white in all spaces.
  bool is_converted() const {
    return desc_.color_space || (is_srgb() && desc_.channels >= 3 && !context_.colors->renders_in_rec709());
  }
  // Only 8-bit texels are decoded when they are looked up.
  TexelFormat kept_format() const {
    if (is_converted()) return TexelFormat::Float;
    return is_srgb() && format() != TexelFormat::Uint8 ? TexelFormat::Float : format();
  }
  uint32_t levels() const { return std::max(desc_.mip_levels, 1u); }
  // Of all levels, for which room is made at once.
  uint64_t kept_size() const {
    return Texture::memory(desc_.width, desc_.height, desc_.channels, kept_format(), levels());
  }
  uint32_t texel_size() const { return bytes_of(format()); }
  uint64_t row_size() const { return uint64_t(desc_.width) * desc_.channels * texel_size(); }
  uint64_t row_stride() const { return desc_.row_stride ? desc_.row_stride : row_size(); }
  const std::byte* row(uint32_t y) const { return static_cast<const std::byte*>(desc_.pixels) + y * row_stride(); }
  // A channel of a row, not decoded.
  float value(const std::byte* row, uint64_t channel) const;

  void check_layout() const;
  float check_values() const;
  TextureImage image() const;
  void convert_row(uint32_t y, std::vector<float>& colors) const;
  TextureImage converted_image(float& maximum) const;

  Subject subject_;
  const bdpt_texture_desc& desc_;
  const bdpt_context& context_;
};

TexelFormat TextureReader::format() const {
  switch (desc_.texel) {
    case BDPT_TEXEL_UINT8:
      return TexelFormat::Uint8;
    case BDPT_TEXEL_UINT16:
      return TexelFormat::Uint16;
    case BDPT_TEXEL_HALF:
      return TexelFormat::Half;
    default:
      return TexelFormat::Float;
  }
}

void TextureReader::check_layout() const {
  if (row_stride() < row_size() || row_stride() > kMaxRowStride || row_stride() % texel_size() != 0)
    subject_.refuse("row_stride", "is ", row_stride(), " bytes: give a multiple of ", texel_size(), " from ",
                    row_size(), " to ", kMaxRowStride, ", or 0 for packed rows");
  if (reinterpret_cast<uintptr_t>(desc_.pixels) % texel_size() != 0)
    subject_.refuse("pixels", "is ", desc_.pixels, ": align it to ", texel_size(), " bytes");
}

float TextureReader::value(const std::byte* row, uint64_t channel) const {
  const std::byte* at = row + channel * texel_size();
  if (desc_.texel == BDPT_TEXEL_FLOAT) {
    float v;
    std::memcpy(&v, at, sizeof v);
    return v;
  }
  if (desc_.texel == BDPT_TEXEL_UINT8) return float(uint8_t(*at)) / 255;
  uint16_t bits;
  std::memcpy(&bits, at, sizeof bits);
  return desc_.texel == BDPT_TEXEL_HALF ? imath_half_to_float(bits) : float(bits) / 65535;
}

float TextureReader::check_values() const {
  float maximum = 0;
  for (uint32_t y = 0; y < desc_.height; ++y)
    for (uint64_t i = 0; i < uint64_t(desc_.width) * desc_.channels; ++i) {
      const float v = value(row(y), i);
      if (!(v >= 0) || !std::isfinite(v))
        subject_.refuse("pixels", "has the value ", v, " at (", i / desc_.channels, ", ", y,
                        "): give finite values of at least 0");
      maximum = std::max(maximum, v);
    }
  return is_srgb() ? std::max(maximum, srgb_to_linear(maximum)) : maximum;
}

TextureImage TextureReader::image() const {
  TextureImage image;
  image.label = subject_.label();
  image.width = desc_.width;
  image.height = desc_.height;
  image.channels = desc_.channels;
  image.format = kept_format();
  image.srgb = is_srgb();
  const uint64_t row_texels = uint64_t(desc_.width) * desc_.channels;
  image.texels.reserve(kept_size());
  const bool has_alpha = desc_.channels % 2 == 0;
  for (uint32_t y = 0; y < desc_.height; ++y) {
    if (image.format == format()) {
      image.texels.insert(image.texels.end(), row(y), row(y) + row_size());
      continue;
    }
    for (uint64_t i = 0; i < row_texels; ++i) {
      const bool is_alpha = has_alpha && i % desc_.channels == desc_.channels - 1;
      const float raw = value(row(y), i), v = is_alpha ? raw : srgb_to_linear(raw);
      const auto* bytes = reinterpret_cast<const std::byte*>(&v);
      image.texels.insert(image.texels.end(), bytes, bytes + sizeof v);
    }
  }
  return image;
}

// Three channels of a row in the rendering space, whatever their number in the texture.
void TextureReader::convert_row(uint32_t y, std::vector<float>& colors) const {
  const std::string space = desc_.color_space ? desc_.color_space : kSrgbTexture;
  const uint32_t last = desc_.channels < 3 ? 0 : 2;
  colors.clear();
  for (uint32_t x = 0; x < desc_.width; ++x)
    for (uint32_t c = 0; c < 3; ++c) {
      colors.push_back(value(row(y), uint64_t(x) * desc_.channels + std::min(c, last)));
      if (!std::isfinite(colors.back()))
        subject_.refuse("pixels", "has the value ", colors.back(), " at (", x, ", ", y, "): give finite values");
    }
  try {
    context_.colors->convert(space, {}, colors.data(), desc_.width);
  } catch (const Error& error) {
    fail(error.code(), "color_space of ", subject_.name(), ": ", error.what());
  }
  constexpr float kGrey = 1e-3f;
  for (uint32_t x = 0; x < desc_.width; ++x) {
    const float* v = &colors[uint64_t(3) * x];
    if (!std::isfinite(v[0]) || !std::isfinite(v[1]) || !std::isfinite(v[2]))
      subject_.refuse("color_space", "\"", space, "\" has no colour for the texel at (", x, ", ", y, ")");
    if (last == 0 && std::abs(v[0] - v[2]) > kGrey * std::abs(v[1]))
      subject_.refuse("color_space", "\"", space, "\" makes grey a colour: give three channels");
  }
}

// maximum becomes that of all channels.
TextureImage TextureReader::converted_image(float& maximum) const {
  constexpr float kRounding = 1e-5f;  // of matrices and tables
  const uint32_t channels = desc_.channels, color_channels = channels < 3 ? 1 : 3;
  TextureImage image{subject_.label(), desc_.width, desc_.height, channels, TexelFormat::Float, false, {}};
  image.texels.reserve(kept_size());
  uint64_t outside = 0;
  float lowest = 0;
  const auto keep = [&](float v) {
    outside += v < -kRounding;
    lowest = std::min(lowest, v);
    v = v > 1 && v < 1 + kRounding ? 1 : std::max(v, 0.0f);
    maximum = std::max(maximum, v);
    const auto* bytes = reinterpret_cast<const std::byte*>(&v);
    image.texels.insert(image.texels.end(), bytes, bytes + sizeof v);
  };
  std::vector<float> colors;
  for (uint32_t y = 0; y < desc_.height; ++y) {
    convert_row(y, colors);
    for (uint32_t x = 0; x < desc_.width; ++x) {
      for (uint32_t c = 0; c < color_channels; ++c) keep(colors[uint64_t(3) * x + c]);
      if (color_channels == channels) continue;
      const float alpha = value(row(y), uint64_t(x) * channels + color_channels);
      if (!(alpha >= 0) || !std::isfinite(alpha))
        subject_.refuse("pixels", "has the alpha ", alpha, " at (", x, ", ", y, "): give finite values of at least 0");
      keep(alpha);
    }
  }
  if (outside > 0)
    context_.log->warning(subject_.name(), ": ", outside,
                          " values lie outside of the rendering space and become 0, the lowest is ", lowest);
  return image;
}

}  // namespace

bdpt_result bdpt_texture_add(bdpt_builder* builder, const bdpt_texture_desc* desc, bdpt_texture_id* texture) {
  return guard(__func__, [&] {
    reset_output(texture);
    bdpt_builder& b = writable(builder);
    const bdpt_texture_desc d = read_struct(desc, "desc");
    require(texture, "texture");
    texture->id = b.textures.add(TextureReader(d, *b.context).read(b.context->meter));
  });
}

bdpt_result bdpt_texture_remove(bdpt_builder* builder, bdpt_texture_id texture) {
  return guard(__func__, [&] {
    bdpt_builder& b = writable(builder);
    const TextureEntry& entry = b.textures.at(texture.id, "texture");
    check_unused(entry.users, "texture", entry.label(), "material or light");
    b.textures.take(texture.id);
  });
}
