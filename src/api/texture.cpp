#include "api/builder.h"
#include "api/check.h"
#include "api/desc.h"

using namespace bdpt;

namespace {

constexpr uint32_t kMaxSide = 65536;
constexpr uint64_t kMaxRowStride = uint64_t(1) << 32;

// A texture with its place in the memory booked.
struct BookedTexture {
  BookedTexture(Booking booking_, Texture texture_) : booking(std::move(booking_)), texture(std::move(texture_)) {}
  Booking booking;
  Texture texture;
};

class TextureReader {
 public:
  explicit TextureReader(const bdpt_texture_desc& desc) : subject_("texture", desc.label), desc_(desc) {
    if (desc.channels != 1 && desc.channels != 3 && desc.channels != 4)
      subject_.refuse("channels", "is ", desc.channels, ": give 1, 3 or 4");
    subject_.check_range("width", desc.width, 1, kMaxSide);
    subject_.check_range("height", desc.height, 1, kMaxSide);
    subject_.check_enum("texel", desc.texel, BDPT_TEXEL_FLOAT);
    subject_.check_enum("encoding", desc.encoding, BDPT_ENCODING_LINEAR);
    if (!desc.pixels) subject_.refuse("pixels", "is NULL: pass the texels");
    check_layout();
  }

  TextureEntry read(const std::shared_ptr<MemoryMeter>& meter) const {
    const uint64_t texels = uint64_t(desc_.width) * desc_.height * kept_channels();
    Booking booking(meter, texels * texel_size(), subject_.name().c_str());
    TextureEntry entry;
    entry.maximum = is_float() ? check_floats() : 1;
    auto booked = std::make_shared<const BookedTexture>(std::move(booking), is_float() ? floats() : bytes());
    entry.texture = std::shared_ptr<const Texture>(booked, &booked->texture);
    return entry;
  }

 private:
  bool is_float() const { return desc_.texel == BDPT_TEXEL_FLOAT; }
  uint32_t texel_size() const { return is_float() ? sizeof(float) : 1; }
  uint32_t kept_channels() const { return desc_.channels == 1 ? 1 : 3; }
  uint64_t row_stride() const {
    return desc_.row_stride ? desc_.row_stride : uint64_t(desc_.width) * desc_.channels * texel_size();
  }

  void check_layout() const;
  float check_floats() const;
  template <class T, class Store>
  void for_each(Store&& store) const;
  Texture bytes() const;
  Texture floats() const;

  Subject subject_;
  const bdpt_texture_desc& desc_;
};

void TextureReader::check_layout() const {
  const uint64_t packed = uint64_t(desc_.width) * desc_.channels * texel_size();
  if (row_stride() < packed || row_stride() > kMaxRowStride || row_stride() % texel_size() != 0)
    subject_.refuse("row_stride", "is ", row_stride(), " bytes: give a multiple of ", texel_size(), " from ", packed,
                    " to ", kMaxRowStride, ", or 0 for packed rows");
  if (reinterpret_cast<uintptr_t>(desc_.pixels) % texel_size() != 0)
    subject_.refuse("pixels", "is ", desc_.pixels, ": align it to ", texel_size(), " bytes");
}

// Calls store(value, x, y) for each channel that is kept.
template <class T, class Store>
void TextureReader::for_each(Store&& store) const {
  for (uint32_t y = 0; y < desc_.height; ++y) {
    const auto* row = reinterpret_cast<const T*>(static_cast<const std::byte*>(desc_.pixels) + y * row_stride());
    for (uint32_t x = 0; x < desc_.width; ++x)
      for (uint32_t c = 0; c < kept_channels(); ++c) store(row[uint64_t(x) * desc_.channels + c], x, y);
  }
}

float TextureReader::check_floats() const {
  float maximum = 0;
  for_each<float>([&](float v, uint32_t x, uint32_t y) {
    if (!(v >= 0) || !std::isfinite(v))
      subject_.refuse("pixels", "has the value ", v, " at (", x, ", ", y, "): give finite values of at least 0");
    maximum = std::max(maximum, v);
  });
  return desc_.encoding == BDPT_ENCODING_SRGB ? srgb_to_linear(maximum) : maximum;
}

Texture TextureReader::bytes() const {
  std::vector<uint8_t> texels;
  texels.reserve(uint64_t(desc_.width) * desc_.height * kept_channels());
  for_each<uint8_t>([&](uint8_t v, uint32_t, uint32_t) { texels.push_back(v); });
  return Texture(subject_.label(), desc_.width, desc_.height, kept_channels(), std::move(texels),
                 desc_.encoding == BDPT_ENCODING_SRGB);
}

Texture TextureReader::floats() const {
  std::vector<float> texels;
  texels.reserve(uint64_t(desc_.width) * desc_.height * kept_channels());
  const bool srgb = desc_.encoding == BDPT_ENCODING_SRGB;
  for_each<float>([&](float v, uint32_t, uint32_t) { texels.push_back(srgb ? srgb_to_linear(v) : v); });
  return Texture(subject_.label(), desc_.width, desc_.height, kept_channels(), std::move(texels));
}

}  // namespace

bdpt_result bdpt_texture_add(bdpt_builder* builder, const bdpt_texture_desc* desc, bdpt_texture_id* texture) {
  return guard(__func__, [&] {
    reset_output(texture);
    bdpt_builder& b = writable(builder);
    const bdpt_texture_desc d = read_struct(desc, "desc");
    require(texture, "texture");
    texture->id = b.textures.add(TextureReader(d).read(b.context->meter));
  });
}

bdpt_result bdpt_texture_remove(bdpt_builder* builder, bdpt_texture_id texture) {
  return guard(__func__, [&] {
    bdpt_builder& b = writable(builder);
    const TextureEntry& entry = b.textures.at(texture.id, "texture");
    check_unused(entry.users, "texture", entry.texture->label(), "material");
    b.textures.take(texture.id);
  });
}
