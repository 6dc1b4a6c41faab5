// The grey scenes against converged images by another renderer's path tracer: every 32 x 32 block agrees within the
// noise stated with the reference, and one per cent.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "agreement.h"

namespace bdpt_tool::tool_reference_test {

struct Case {
  const char* name;
  std::uint32_t width, height, max_edges;
  std::uint64_t passes;  // of each seed
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

// The blocks' means and standard errors, row by row.
std::vector<Mean> read_reference(const std::string& path) {
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::regex block(R"re("mean":([-+.eE0-9]+),"standard_error":([-+.eE0-9]+))re");
  std::vector<Mean> blocks;
  for (auto i = std::sregex_iterator(text.begin(), text.end(), block); i != std::sregex_iterator(); ++i)
    blocks.push_back({std::stod((*i)[1]), std::stod((*i)[2]), 0});
  return blocks;
}

class Reference : public testing::TestWithParam<Case> {};

TEST_P(Reference, AgreesInEveryBlock) {
  const Case& c = GetParam();
  const std::string shared = BDPT_SHARED_DIR;
  const std::string scene_path = shared + "/scenes/bitterli/" + c.name + "/scene-v4-grey.pbrt";
  const std::string reference_path = shared + "/references/" + c.name + "-grey.json";
  if (!std::filesystem::exists(scene_path) || !std::filesystem::exists(reference_path))
    GTEST_SKIP() << "no " << reference_path;

  const std::vector<Mean> reference = read_reference(reference_path);
  Diagnostics diagnostics(false);
  const SceneUnderTest scene = load_scene(scene_path, {c.width, c.height}, c.max_edges, diagnostics);
  const BlockMeans ours = render_blocks(scene, {"bidirectional", parse_technique_mask("all"), c.passes, {}}, 16, 1);
  // The reference has the blocks that lie wholly within the image across, and all rows of them.
  ASSERT_EQ(reference.size(), ours.plain.size());

  // A reference's error comes from two to six seeds and is itself known only roughly: none counts as less than what
  // is usual in its image. 4 deviations leave one false alarm in a thousand images of 16 blocks.
  double usual = 0;
  for (const Mean& m : reference) usual += m.error / m.value / double(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const Mean m = mean_of(ours.plain[i]);
    const double noise = std::hypot(std::max(reference[i].error, usual * reference[i].value), m.error);
    EXPECT_NEAR(m.value, reference[i].value, 4 * noise + 0.01 * reference[i].value) << "block " << i;
    if (std::getenv("BDPT_VALIDATE_TABLES"))
      std::printf("  %s block %2zu: %.6g, reference %.6g, differ by %+.2f %%, errors %.2f %% and %.2f %%\n", c.name, i,
                  m.value, reference[i].value, 100 * (m.value / reference[i].value - 1), 100 * m.error / m.value,
                  100 * reference[i].error / reference[i].value);
  }
}

INSTANTIATE_TEST_SUITE_P(Grey, Reference,
                         testing::Values(Case{"cornell-box", 128, 128, 6, 8}, Case{"veach-mis", 160, 90, 4, 40},
                                         Case{"veach-ajar", 160, 90, 14, 16}, Case{"veach-bidir", 128, 128, 6, 24}),
                         [](const testing::TestParamInfo<Case>& info) {
                           std::string name = info.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace bdpt_tool::tool_reference_test
