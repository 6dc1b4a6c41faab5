#include "api/check.h"
#include "api/desc.h"
#include "api/handles.h"
#include "api/read_rect.h"

using namespace bdpt;

bdpt_result bdpt_film_read_coverage(const bdpt_film* film, const bdpt_coverage_desc* desc, bdpt_coverage* entries,
                                    uint64_t capacity, double* lost) {
  return guard(__func__, [&] {
    const Film& f = *require(film, "film").film;
    const bdpt_coverage_desc d = read_struct(desc, "desc");
    require(entries, "entries");
    const Subject subject("desc", nullptr);
    if (f.desc().coverages == 0)
      fail(ErrorCode::InvalidArgument, "film has no coverage: its camera was created without such an output");
    subject.check_range("coverage", d.coverage, 0, f.desc().coverages - 1);
    subject.check_range("ranks", d.ranks, 1, PixelCoverage::kSlots);
    subject.check_flag("include_partial", d.include_partial);
    const PixelRect rect = read_rect(subject, "rect", d.rect, f.desc().width, f.desc().height);
    const uint64_t needed = rect.count() * d.ranks;
    if (capacity < needed)
      fail(ErrorCode::InvalidArgument, "capacity is ", capacity, " entries: ", needed, " are needed");
    double left_out = 0;
    const bool partial = d.include_partial != 0 && !film->busy.is_set();
    const auto covered = f.read_coverage(d.coverage, rect, d.ranks, partial, left_out);
    for (size_t i = 0; i < covered.size(); ++i) entries[i] = {covered[i].id, float(covered[i].part), 0};
    if (lost) *lost = left_out;
  });
}
