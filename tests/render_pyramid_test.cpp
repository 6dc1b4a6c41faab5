// The picture is the sum of its pyramid of techniques, and of its eye and its light image.
#include "rendering.h"

namespace bdpt::render_pyramid_test {

using namespace rendering;

class RenderPyramid : public ::testing::TestWithParam<std::tuple<bool, FilterType, Heuristic, Adaptive>> {
 protected:
  static constexpr int kMaxEdges = 6;
  Picture picture() const {
    FilmDesc film = film_desc(24, 20, kMaxEdges);
    film.normalize_by_weights = std::get<0>(GetParam());
    film.filter.type = std::get<1>(GetParam());
    film.groups = 2;
    RenderDesc desc;
    desc.transport.max_edges = kMaxEdges;
    desc.transport.heuristic = std::get<2>(GetParam());
    desc.transport.adaptive = std::get<3>(GetParam());
    const ScenePointer scene =
        scenes::room({.contents = scenes::Contents::Specular, .points = true, .environment = true}).build();
    return render(scene, scenes::camera(scenes::room_view_through_lens(), 24, 20), film, desc, 5);
  }
};

TEST_P(RenderPyramid, SumsToThePicture) {
  const Picture p = picture();
  const std::vector<float> color = read(*p.film), eye = read(*p.film, FilmLayer::Eye),
                           light = read(*p.film, FilmLayer::Light);
  std::vector<double> sums(color.size()), light_sums(color.size()), scale(color.size());
  for (int k = 1; k <= kMaxEdges; ++k)
    for (int s = 0; s <= k + 1; ++s) {
      const std::vector<float> layer = read(*p.film, FilmLayer::Technique, s, k + 1 - s);
      for (size_t i = 0; i < sums.size(); ++i) {
        sums[i] += layer[i];
        if (k + 1 - s <= 1) light_sums[i] += layer[i];
        scale[i] += std::fabs(layer[i]);
      }
    }
  for (size_t i = 0; i < sums.size(); ++i) {
    const double tolerance = 1e-6 * (scale[i] + 1e-6);
    EXPECT_NEAR(color[i], sums[i], tolerance) << i;
    EXPECT_NEAR(light[i], light_sums[i], tolerance) << i;
    EXPECT_NEAR(color[i], double(eye[i]) + light[i], tolerance) << i;
  }
  EXPECT_EQ(p.film->rejected() + p.stats.rejected, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, RenderPyramid,
                         ::testing::Combine(::testing::Bool(), ::testing::Values(FilterType::Box, FilterType::Mitchell),
                                            ::testing::Values(Heuristic::Power, Heuristic::Cutoff, Heuristic::None),
                                            ::testing::Values(Adaptive::None, Adaptive::TwoStages)));

}  // namespace bdpt::render_pyramid_test
