#include "api/check.h"
#include "api/desc.h"
#include "api/handles.h"
#include "api/output.h"

using namespace bdpt;

namespace {

bdpt_advance_desc read_advance(const bdpt_advance_desc* caller, const Film& film) {
  const bdpt_advance_desc desc = read_struct(caller, "desc");
  const Subject subject("desc", nullptr);
  subject.check_reserved("reserved", desc.reserved);
  for (const auto& [field, value] : {std::pair("seconds", desc.seconds), std::pair("noise", desc.noise)})
    if (!(value >= 0) || !std::isfinite(value))
      subject.refuse(field, "is ", value, ": give a finite value of at least 0");
  if (desc.passes == 0 && desc.seconds == 0 && desc.noise == 0)
    fail(ErrorCode::InvalidArgument, "desc sets no limit: set passes, seconds or noise");
  if (desc.noise > 0 && film.desc().groups < 2)
    subject.refuse("noise", "is ", desc.noise,
                   ", but a film of one group cannot tell its noise: create it with two or more");
  return desc;
}

bdpt_progress to_host(const Progress& from) {
  bdpt_progress progress{};
  progress.struct_size = sizeof progress;
  progress.fraction = from.fraction;
  progress.seconds = from.seconds;
  progress.passes = from.passes;
  progress.samples = from.samples;
  return progress;
}

AdvanceDesc to_engine(const bdpt_advance_desc& desc, HostCalls& calls, Output& output) {
  AdvanceDesc advance;
  advance.passes = desc.passes;
  advance.seconds = desc.seconds;
  advance.noise = desc.noise;
  if (desc.cancel) advance.cancel = &desc.cancel->requested;
  if (desc.progress)
    advance.on_progress = [&desc, &calls](const Progress& progress) {
      return calls.run("desc.progress", [&] {
        const bdpt_progress told = to_host(progress);
        return desc.progress(desc.progress_user, &told);
      });
    };
  if (desc.sink) advance.on_pass = [&output](uint64_t passes) { return output.pass_done(passes); };
  return advance;
}

void write_report(const AdvanceReport& from, const bdpt_advance_desc& desc, const Film& film,
                  bdpt_advance_report* report) {
  if (!report) return;
  bdpt_advance_report result{};
  result.reason = static_cast<bdpt_stop_reason>(from.reason);
  result.passes = from.passes;
  result.next_pass = from.next_pass;
  result.seconds = from.seconds;
  result.relative_error = desc.noise > 0 ? film.relative_error() : -1;  // it takes as long as reading the image
  write_struct(result, report);
}

}  // namespace

bdpt_result bdpt_render_advance(bdpt_render* render, const bdpt_advance_desc* desc, bdpt_advance_report* report) {
  return guard(__func__, [&] {
    bdpt_render& r = require(render, "render");
    r.busy.check("render");
    r.film->busy.check("film");
    if (report) check_output_struct(report, "report");
    const Film& film = *r.film->film;
    const bdpt_advance_desc d = read_advance(desc, film);
    HostCalls calls;
    Output output(d.sink, film, calls, *r.context->executor);
    const Ref<bdpt_cancel> cancel(d.cancel);  // the host's callbacks may release theirs
    const Busy::Mark render_mark(r.busy), film_mark(r.film->busy);
    AdvanceReport done = r.render->advance(to_engine(d, calls, output));
    output.finish();
    if (calls.failed()) done.reason = StopReason::Callback;
    write_report(done, d, film, report);
    calls.check();
    return bdpt_result(done.reason == StopReason::Cancelled ? BDPT_CANCELLED : BDPT_OK);
  });
}
