#include "medium/medium.h"

#include "api/builder.h"
#include "api/check.h"
#include "api/desc.h"

#include <cmath>

using namespace bdpt;

namespace {

constexpr float kMaxSigma = 1e9f;      // contributions have products of two
constexpr float kMaxCosine = 0.9999f;  // lobes much narrower are not told from light that goes on

std::shared_ptr<const Medium> read_medium(const bdpt_medium_desc& desc) {
  const Subject subject("medium", desc.label);
  subject.check_reserved("reserved", desc.reserved);
  subject.check_reserved("reserved2", desc.reserved2);
  subject.check_range("sigma_a", desc.sigma_a, 3, 0, kMaxSigma);
  subject.check_range("sigma_s", desc.sigma_s, 3, 0, kMaxSigma);
  if (!(std::fabs(desc.g) <= kMaxCosine))
    subject.refuse("g", "is ", desc.g, ": give a mean cosine from ", -kMaxCosine, " to ", kMaxCosine);
  return std::make_shared<const Medium>(Medium{subject.label(), to_rgb(desc.sigma_a), to_rgb(desc.sigma_s), desc.g});
}

}  // namespace

bdpt_result bdpt_medium_add(bdpt_builder* builder, const bdpt_medium_desc* desc, bdpt_medium_id* medium) {
  return guard(__func__, [&] {
    reset_output(medium);
    bdpt_builder& b = writable(builder);
    const bdpt_medium_desc d = read_struct(desc, "desc");
    require(medium, "medium");
    medium->id = b.media.add({read_medium(d), 0});
  });
}

bdpt_result bdpt_medium_update(bdpt_builder* builder, bdpt_medium_id medium, const bdpt_medium_desc* desc) {
  return guard(__func__, [&] {
    bdpt_builder& b = writable(builder);
    const bdpt_medium_desc d = read_struct(desc, "desc");
    MediumEntry& entry = b.media.at(medium.id, "medium");
    entry.medium = read_medium(d);
  });
}

bdpt_result bdpt_medium_remove(bdpt_builder* builder, bdpt_medium_id medium) {
  return guard(__func__, [&] {
    bdpt_builder& b = writable(builder);
    const MediumEntry& entry = b.media.at(medium.id, "medium");
    check_unused(entry.users, "medium", entry.medium->label, "material");
    b.media.take(medium.id);
  });
}
