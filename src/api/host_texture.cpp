// Textures of the host's: its functions as the scene asks them.
#include "geometry/host_texture.h"

#include "api/builder.h"
#include "api/check.h"
#include "api/desc.h"
#include "api/host_calls.h"
#include "render/float_mode.h"

#include <vector>

using namespace bdpt;

namespace {

constexpr float kDefaultStep = 1 / 1024.0f, kLeastStep = 1e-6f;

class HostFunction final : public HostTexture {
 public:
  HostFunction(const bdpt_host_texture_desc& desc, FinalCall drop) : desc_(desc), drop_(std::move(drop)) {
    label = text_or_empty(desc.label);
    maximum = desc.maximum == 0 ? 1 : desc.maximum;
    step = desc.step[0] == 0 ? Vec2(kDefaultStep) : Vec2(desc.step[0], desc.step[1]);
    hash = desc.hash;
    desc_.label = nullptr;
  }

  void look_up(size_t count, const TexturePlace* places, Rgba* colors) const override {
    std::vector<bdpt_texture_place> told(count);
    for (size_t i = 0; i < count; ++i) {
      const TexturePlace& from = places[i];
      told[i] = {{from.uv.x, from.uv.y}, {from.position.x, from.position.y, from.position.z}, 0, {from.instance}};
    }
    if (const int32_t result = call(told, reinterpret_cast<float(*)[4]>(colors)); result != 0)
      fail(ErrorCode::CallbackFailed, "look_up of ", name(), " returned ", result, ", which stops the call");
  }

 private:
  std::string name() const { return Subject("texture", label.c_str()).name(); }
  int32_t call(const std::vector<bdpt_texture_place>& places, float (*colors)[4]) const {
    const HostFloatMode mode;
    try {
      return desc_.look_up(desc_.user, uint32_t(places.size()), places.data(), colors);
    } catch (...) {
      fail(ErrorCode::CallbackFailed, "look_up of ", name(),
           " threw an exception: a callback must return a value instead");
    }
  }

  bdpt_host_texture_desc desc_;
  FinalCall drop_;
};

void check(const bdpt_host_texture_desc& desc) {
  const Subject subject("texture", desc.label);
  if (!desc.look_up) subject.refuse("look_up", "is NULL: give the function that computes the colours");
  subject.check_not_negative("maximum", &desc.maximum, 1);
  for (float v : desc.step)
    if (desc.step[0] != 0 || desc.step[1] != 0) subject.check_range("step", v, kLeastStep, 1);
}

}  // namespace

bdpt_result bdpt_host_texture_add(bdpt_builder* builder, const bdpt_host_texture_desc* desc, bdpt_texture_id* texture) {
  return guard(__func__, [&] {
    reset_output(texture);
    FinalCall drop = is_readable(desc) ? FinalCall(desc->drop, desc->user) : FinalCall();
    bdpt_builder& b = writable(builder);
    const bdpt_host_texture_desc d = read_struct(desc, "desc");
    require(texture, "texture");
    check(d);
    TextureEntry entry;
    entry.host = std::make_shared<const HostFunction>(d, std::move(drop));
    entry.maximum = entry.host->maximum;
    texture->id = b.textures.add(std::move(entry));
  });
}
