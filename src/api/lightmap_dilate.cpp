#include "api/check.h"
#include "api/desc.h"
#include "api/lightmap_buffers.h"
#include "lightmap/dilate.h"

#include <algorithm>

using namespace bdpt;

namespace {

constexpr uint32_t kDefaultSteps = 4;

DilateImage read_image(const bdpt_lightmap_dilate_desc& desc) {
  const Subject subject("desc", nullptr);
  check_atlas_size(subject, desc.width, desc.height);
  check_channels(subject, desc.channels);
  subject.check_reserved("reserved", desc.reserved);
  const uint64_t texels = uint64_t(desc.width) * desc.height;
  check_buffer(subject, "pixels", desc.pixels, alignof(float), desc.pixels_capacity,
               texels * desc.channels * sizeof(float));
  check_buffer(subject, "mask", desc.mask, 1, desc.mask_capacity, texels);
  if (desc.charts)
    check_buffer(subject, "charts", desc.charts, alignof(uint32_t), desc.charts_capacity, texels * sizeof(uint32_t));
  return {desc.width, desc.height, desc.channels, desc.pixels, desc.mask, desc.charts};
}

void write(const Dilation& dilation, const bdpt_lightmap_dilate_desc& desc) {
  for (const size_t texel : dilation.not_finite) desc.mask[texel] = 0;
  for (size_t i = 0; i < dilation.texels.size(); ++i) {
    const size_t texel = dilation.texels[i];
    std::copy_n(&dilation.values[i * desc.channels], desc.channels, desc.pixels + texel * desc.channels);
    desc.mask[texel] = 1;
    if (desc.charts) desc.charts[texel] = dilation.charts[i];
  }
}

}  // namespace

bdpt_result bdpt_lightmap_dilate(const bdpt_lightmap_dilate_desc* desc, bdpt_lightmap_dilate_report* report) {
  return guard(__func__, [&] {
    const bdpt_lightmap_dilate_desc d = read_struct(desc, "desc");
    if (report) check_output_struct(report, "report");
    const Dilation dilation = dilate(read_image(d), d.steps ? d.steps : kDefaultSteps);
    write(dilation, d);
    if (!report) return;
    bdpt_lightmap_dilate_report r{};
    r.filled = dilation.texels.size();
    r.not_finite = dilation.not_finite.size();
    r.left = dilation.left;
    write_struct(r, report);
  });
}
