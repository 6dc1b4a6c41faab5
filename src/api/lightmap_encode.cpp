#include "api/check.h"
#include "api/desc.h"
#include "api/lightmap_buffers.h"
#include "lightmap/directional.h"
#include "lightmap/encode.h"

using namespace bdpt;

namespace {

constexpr uint64_t kMaxTexels = uint64_t(1) << 32, kMaxTexelStride = 65536, kMaxPlaneStride = uint64_t(1) << 40;
constexpr float kRgbmRange = 8, kRgbdRange = 255;

// What a texel of each encoding is made of and becomes.
struct Layout {
  uint32_t planes;     // coefficients; 0 = plain floats
  uint32_t floats;     // that are read: of a coefficient, or of the texel; 0 = the description's channels
  uint32_t bytes;      // that are written; 0 = two for each channel
  uint32_t alignment;  // of what is written
  float range;         // default; 0 = it has none
};

constexpr Layout kLayouts[] = {
    {0, 0, 0, alignof(uint16_t), 0},
    {0, 3, 4, 1, kRgbmRange},
    {0, 3, 4, 1, kRgbdRange},
    {4, 3, kDominantFloats * sizeof(float), alignof(float), 0},
    {4, 3, kMonoShFloats * sizeof(float), alignof(float), 0},
    {9, 3, 4 * 3 * sizeof(float), alignof(float), 0},
    {9, 3, 6 * 3 * sizeof(float), alignof(float), 0},
};

struct Job {
  Layout layout;
  uint64_t texel_stride, plane_stride;
  float range;
};

uint64_t read_float_stride(const Subject& subject, const char* field, uint64_t stride, uint64_t least, uint64_t most) {
  if (stride == 0) return least;
  if (stride < least || stride > most)
    subject.refuse(field, "is ", stride, ": give ", least, " to ", most, " floats, or 0");
  return stride;
}

Job read_job(const bdpt_lightmap_encode_desc& desc) {
  const Subject subject("desc", nullptr);
  subject.check_enum("encoding", desc.encoding, BDPT_LIGHTMAP_ENCODING_H6);
  Job job{kLayouts[desc.encoding], 0, 0, 0};
  Layout& layout = job.layout;
  if (layout.floats == 0) {
    check_channels(subject, desc.channels);
    layout.floats = desc.channels;
    layout.bytes = desc.channels * uint32_t(sizeof(uint16_t));
  } else if (desc.channels != 0) {
    subject.refuse("channels", "is ", desc.channels, ": give it with BDPT_LIGHTMAP_ENCODING_HALF only, else 0");
  }
  subject.check_enum("sh", desc.sh, layout.planes ? BDPT_SH_IRRADIANCE : BDPT_SH_RADIANCE);
  subject.check_reserved("reserved", desc.reserved);
  if (desc.texels < 1 || desc.texels > kMaxTexels)
    subject.refuse("texels", "is ", desc.texels, ": give 1 to ", kMaxTexels);
  if (layout.planes == 0 && desc.plane_stride != 0)
    subject.refuse("plane_stride", "is ", desc.plane_stride, ": this encoding reads no coefficients; give 0");
  job.plane_stride = read_float_stride(subject, "plane_stride", desc.plane_stride, 3, kMaxPlaneStride);
  // Packed: a texel's coefficients behind one another, or in images of their own.
  const uint64_t packed = job.plane_stride == 3 ? uint64_t(layout.planes) * 3 : 3;
  job.texel_stride =
      layout.planes != 0 && desc.texel_stride == 0
          ? packed
          : read_float_stride(subject, "texel_stride", desc.texel_stride, layout.floats, kMaxTexelStride);
  subject.check_not_negative("range", &desc.range, 1);
  if (desc.range != 0 && layout.range == 0)
    subject.refuse("range", "is ", desc.range, ": give it with RGBM and RGBD only, else 0");
  job.range = desc.range != 0 ? desc.range : layout.range;
  return job;
}

void check_buffers(const bdpt_lightmap_encode_desc& desc, const Job& job) {
  const Subject subject("desc", nullptr);
  const uint64_t planes = job.layout.planes ? job.layout.planes : 1;
  const uint64_t floats = (desc.texels - 1) * job.texel_stride + (planes - 1) * job.plane_stride + job.layout.floats;
  const uint64_t read = floats * sizeof(float), written = desc.texels * job.layout.bytes;
  check_buffer(subject, "pixels", desc.pixels, alignof(float), desc.pixels_capacity, read);
  check_buffer(subject, "encoded", desc.encoded, job.layout.alignment, desc.encoded_capacity, written);
  const uint64_t from = reinterpret_cast<uintptr_t>(desc.pixels), to = reinterpret_cast<uintptr_t>(desc.encoded);
  if (from < to + written && to < from + read) subject.refuse("encoded", "overlaps pixels: give a buffer of its own");
}

EncodeCounts encode(const bdpt_lightmap_encode_desc& desc, const Job& job) {
  const FloatTexels plain{desc.pixels, size_t(desc.texels), size_t(job.texel_stride)};
  const ShTexels sh{desc.pixels, size_t(desc.texels), size_t(job.texel_stride), size_t(job.plane_stride),
                    desc.sh == BDPT_SH_IRRADIANCE ? ShKind::Irradiance : ShKind::Radiance};
  auto* floats = static_cast<float*>(desc.encoded);
  auto* bytes = static_cast<uint8_t*>(desc.encoded);
  switch (desc.encoding) {
    case BDPT_LIGHTMAP_ENCODING_HALF:
      return encode_half(plain, desc.channels, static_cast<uint16_t*>(desc.encoded));
    case BDPT_LIGHTMAP_ENCODING_RGBM:
      return encode_rgbm(plain, job.range, bytes);
    case BDPT_LIGHTMAP_ENCODING_RGBD:
      return encode_rgbd(plain, job.range, bytes);
    case BDPT_LIGHTMAP_ENCODING_DOMINANT:
      return encode_dominant(sh, floats);
    case BDPT_LIGHTMAP_ENCODING_MONO_SH:
      return encode_mono_sh(sh, floats);
    case BDPT_LIGHTMAP_ENCODING_H4:
      return encode_h_basis(sh, 4, floats);
    default:
      return encode_h_basis(sh, 6, floats);
  }
}

}  // namespace

bdpt_result bdpt_lightmap_encode(const bdpt_lightmap_encode_desc* desc, bdpt_lightmap_encode_report* report) {
  return guard(__func__, [&] {
    const bdpt_lightmap_encode_desc d = read_struct(desc, "desc");
    if (report) check_output_struct(report, "report");
    const Job job = read_job(d);
    check_buffers(d, job);
    const EncodeCounts counts = encode(d, job);
    if (!report) return;
    bdpt_lightmap_encode_report r{};
    r.clipped = counts.clipped;
    r.not_finite = counts.not_finite;
    write_struct(r, report);
  });
}
