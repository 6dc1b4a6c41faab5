// On real scenes path tracing, light tracing where it can see the paths, and bidirectional path tracing measure the
// same. BDPT_VALIDATE=full in the environment takes longer paths and more samples (scripts/validate); what runs by
// default is chosen so that every threshold is below one per cent of its block within minutes; the room behind a door
// needs too many for that. (By default all plans are compared there, and bidirectional path tracing with a reference.)
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "agreement.h"

namespace bdpt_tool::tool_agreement_test {

constexpr int kSeeds = 32;

struct Case {
  const char* name;
  const char* file;
  std::uint32_t width, height, max_edges;
  std::uint64_t passes, bdpt_passes;    // for each seed
  std::vector<std::uint32_t> left_out;  // blocks: light tracing does not see through specular surfaces (veach_bidir);
                                        // small lamps in smooth plates, caustics by chance take hours, see full()
  std::array<std::uint32_t, 4> crop = {};  // what is measured, see Frame
  bool lights_seen = true;  // false: without paths of one edge, for lights so small that s = 0 misses them
  bool paired = false;      // the same seeds for both, see compare_blocks
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

bool full() {
  const char* mode = std::getenv("BDPT_VALIDATE");
  return mode && std::string(mode) == "full";
}

// Path tracing finds what is lit through a shade or by a caustic by chance alone, and needs billions of samples for
// one per cent: by default its paths end where that begins. So with light tracing and what glossy surfaces show.
std::vector<Case> path_cases() {
  if (full())
    return {{"cornell_box", "cornell-box/scene-v4.pbrt", 64, 64, 6, 200, 100, {}},
            {"veach_mis", "veach-mis/scene-v4.pbrt", 64, 36, 2, 4000, 3000, {}, {}, false},
            {"veach_bidir", "veach-bidir/scene-v4.pbrt", 64, 64, 3, 2800, 200, {3}},
            {"veach_bidir_egg", "veach-bidir/scene-v4.pbrt", 64, 64, 3, 10000, 10000, {}, {32, 32, 64, 64}, true, true},
            {"veach_ajar", "veach-ajar/scene-v4-present-textures.pbrt", 64, 32, 6, 8000, 4000, {}},
            {"water_caustic", "water-caustic/scene-v4.pbrt", 192, 192, 2, 200, 200, {}, {0, 0, 192, 32}, false}};
  return {{"cornell_box", "cornell-box/scene-v4.pbrt", 64, 64, 6, 40, 20, {}},
          {"veach_mis", "veach-mis/scene-v4.pbrt", 64, 36, 2, 60, 60, {0}, {}, false},
          {"veach_bidir", "veach-bidir/scene-v4.pbrt", 64, 64, 3, 700, 100, {3}},
          {"water_caustic", "water-caustic/scene-v4.pbrt", 192, 192, 2, 20, 20, {}, {0, 0, 192, 32}, false}};
}
std::vector<Case> light_cases() {
  if (full())
    return {{"cornell_box", "cornell-box/scene-v4.pbrt", 64, 64, 6, 200, 100, {}},
            {"veach_mis", "veach-mis/scene-v4.pbrt", 64, 36, 2, 5500, 3000, {}, {}, false},
            {"veach_bidir", "veach-bidir/scene-v4.pbrt", 64, 64, 6, 400, 400, {3}},
            {"veach_ajar", "veach-ajar/scene-v4-present-textures.pbrt", 64, 32, 6, 3000, 900, {}},
            {"water_caustic", "water-caustic/scene-v4.pbrt", 192, 192, 6, 400, 400, {}, {0, 0, 192, 32}}};
  return {{"cornell_box", "cornell-box/scene-v4.pbrt", 64, 64, 6, 30, 20, {}},
          {"veach_mis", "veach-mis/scene-v4.pbrt", 64, 36, 2, 1000, 60, {0, 1}, {}, false},
          {"veach_bidir", "veach-bidir/scene-v4.pbrt", 64, 64, 6, 30, 30, {3}},
          {"water_caustic", "water-caustic/scene-v4.pbrt", 192, 192, 3, 200, 150, {}, {0, 0, 192, 32}}};
}

Variant path_tracing(std::uint64_t passes) {
  return {"path tracing", parse_technique_mask("s<=1&t>=2"), passes, parse_technique_mask("s=1&t>=2")};
}
Variant light_tracing(std::uint64_t passes) {
  return {"light tracing", parse_technique_mask("t<=1"), passes, parse_technique_mask("t=1")};
}
Variant bidirectional(std::uint64_t passes) { return {"bidirectional", parse_technique_mask("all"), passes, {}}; }

Variant without_one_edge(Variant variant) {
  for (std::uint32_t s = 0; s <= 2; ++s) variant.techniques[s] &= ~(1u << (2 - s));
  return variant;
}

class Agree : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    path_ = std::string(BDPT_SHARED_DIR) + "/scenes/bitterli/" + GetParam().file;
    if (!std::filesystem::exists(path_)) GTEST_SKIP() << "no " << path_;
  }

  void expect_agreement(Variant variant) {
    const Case& c = GetParam();
    Variant both = bidirectional(c.bdpt_passes);
    if (!c.lights_seen) variant = without_one_edge(variant), both = without_one_edge(both);
    Diagnostics diagnostics(false);
    const SceneUnderTest scene = load_scene(path_, {c.width, c.height, c.crop}, c.max_edges, diagnostics);
    const BlockMeans reference = render_blocks(scene, both, kSeeds, 1);
    const BlockMeans means = render_blocks(scene, variant, kSeeds, c.paired ? 1 : 1001);
    const Agreement plain = compare_blocks(means.plain, reference.plain, c.left_out, c.paired);
    EXPECT_LE(plain.worst, 1) << variant.name << " and bidirectional differ\n" << plain.table;
    EXPECT_LE(plain.widest, 0.01) << "too noisy to tell\n" << plain.table;
    const Agreement planted = compare_blocks(means.planted, reference.plain, c.left_out, c.paired);
    EXPECT_GT(planted.worst, 1) << "a factor of 1.02 in one technique goes unnoticed\n" << planted.table;
    if (std::getenv("BDPT_VALIDATE_TABLES"))
      std::printf("%s, %s, k = %u:\n%s", c.name, variant.name.c_str(), c.max_edges, plain.table.c_str());
  }

  std::string path_;
};

class PathAndBidirectional : public Agree {};
class LightAndBidirectional : public Agree {};

std::string name_of(const testing::TestParamInfo<Case>& info) { return info.param.name; }

TEST_P(PathAndBidirectional, Agree) { expect_agreement(path_tracing(GetParam().passes)); }
INSTANTIATE_TEST_SUITE_P(Scenes, PathAndBidirectional, testing::ValuesIn(path_cases()), name_of);

TEST_P(LightAndBidirectional, Agree) { expect_agreement(light_tracing(GetParam().passes)); }
INSTANTIATE_TEST_SUITE_P(Scenes, LightAndBidirectional, testing::ValuesIn(light_cases()), name_of);

}  // namespace bdpt_tool::tool_agreement_test
