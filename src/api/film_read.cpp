#include "api/check.h"
#include "api/desc.h"
#include "api/handles.h"
#include "api/read_rect.h"

#include <algorithm>

using namespace bdpt;

namespace {

constexpr uint64_t kPixelSize = 3 * sizeof(float);
constexpr uint64_t kMaxRowStride = uint64_t(1) << 40;

// (s,t) must be a technique that the film keeps an image of.
void check_layer(const Subject& subject, const bdpt_read_desc& desc, const FilmDesc& film) {
  subject.check_enum("layer", desc.layer, BDPT_LAYER_SAMPLES);
  if (desc.layer == BDPT_LAYER_SAMPLES && !film.counts)
    subject.refuse("layer", "is the number of samples, which films of cameras with outputs alone keep");
  if (film.one_image && (desc.layer == BDPT_LAYER_EYE || desc.layer == BDPT_LAYER_LIGHT))
    subject.refuse("layer",
                   "is the eye or the light image alone, which films of sensors without pixels do not keep: "
                   "read BDPT_LAYER_COLOR");
  subject.check_range("plane", desc.plane, 0, film.planes - 1);
  if (desc.layer == BDPT_LAYER_TECHNIQUE && desc.plane > 0)
    subject.refuse("plane", "is ", desc.plane, ": the film keeps techniques of plane 0 alone");
  if (desc.layer != BDPT_LAYER_TECHNIQUE) return;
  const uint64_t vertices = uint64_t(desc.s) + desc.t;
  if (vertices < 2 || vertices > uint64_t(film.pyramid_edges) + 1)
    subject.refuse("s and t", "are ", desc.s, " and ", desc.t, ": the film keeps the techniques of paths of 1 to ",
                   film.pyramid_edges, " edges (pyramid_edges), where s + t is the number of edges plus 1");
}

// The bytes from row to row.
uint64_t read_row_stride(const Subject& subject, const bdpt_read_desc& desc, const PixelRect& rect, uint64_t capacity) {
  const uint64_t packed = uint64_t(rect.x1 - rect.x0) * kPixelSize, rows = uint64_t(rect.y1 - rect.y0);
  const uint64_t stride = desc.row_stride ? desc.row_stride : packed;
  if (stride < packed || stride > kMaxRowStride || stride % sizeof(float) != 0)
    subject.refuse("row_stride", "is ", stride, " bytes: give a multiple of 4 from ", packed, " to ", kMaxRowStride,
                   ", or 0 for packed rows");
  const uint64_t needed = (rows - 1) * stride + packed;
  if (capacity < needed) fail(ErrorCode::InvalidArgument, "capacity is ", capacity, " bytes: ", needed, " are needed");
  return stride;
}

void turn_over(float* pixels, const PixelRect& rect, size_t row_stride) {
  const size_t width = size_t(rect.x1 - rect.x0) * 3, rows = size_t(rect.y1 - rect.y0);
  for (size_t top = 0, bottom = rows - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(pixels + top * row_stride, pixels + top * row_stride + width, pixels + bottom * row_stride);
}

}  // namespace

bdpt_result bdpt_film_read(const bdpt_film* film, const bdpt_read_desc* desc, float* pixels, uint64_t capacity) {
  return guard(__func__, [&] {
    const Film& f = *require(film, "film").film;
    const bdpt_read_desc d = read_struct(desc, "desc");
    require(pixels, "pixels");
    if (reinterpret_cast<uintptr_t>(pixels) % alignof(float) != 0)
      fail(ErrorCode::InvalidArgument, "pixels is ", pixels, ": align it to 4 bytes");
    const Subject subject("desc", nullptr);
    check_layer(subject, d, f.desc());
    subject.check_flag("flip", d.flip);
    subject.check_flag("include_partial", d.include_partial);
    const PixelRect rect = read_rect(subject, "rect", d.rect, f.desc().width, f.desc().height);
    const size_t row_stride = size_t(read_row_stride(subject, d, rect, capacity) / sizeof(float));
    // While a render is at work there is a pass in hand, but none that was interrupted.
    const bool partial = d.include_partial != 0 && !film->busy.is_set();
    f.read(static_cast<FilmLayer>(d.layer), int(d.s), int(d.t), rect, partial, pixels, row_stride, int(d.plane));
    if (d.flip) turn_over(pixels, rect, row_stride);
  });
}
