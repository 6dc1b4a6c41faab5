// Plans, heuristics, roulettes, samplers and numbers in every pair, in rooms of our own: all measure the same.
#include "plan_cover.h"

namespace bdpt::transport_cover_test {

using namespace cover;
using scenes::Contents;

constexpr int kSize = 64;

void expect_room_agrees(const scenes::RoomOptions& room, const scenes::Viewpoint& view) {
  expect_cover_agrees(scenes::room(room).build(), scenes::camera(view, kSize, kSize), 5);
}

TEST(TransportCover, DiffuseRoom) { expect_room_agrees({.points = true}, scenes::room_view()); }
TEST(TransportCover, GlassAndMirrorThroughALens) {
  expect_room_agrees({.contents = Contents::Specular}, scenes::room_view_through_lens());
}
TEST(TransportCover, GlossySurfacesAndAnEnvironment) {
  expect_room_agrees({.contents = Contents::Glossy, .environment = true}, scenes::room_view());
}

TEST(TransportCover, HoldsEveryPair) {
  const Choice n = sizes();
  const std::vector<Choice> rows = pairwise_cover(n);
  for (size_t a = 0; a < kFactors; ++a)
    for (size_t b = a + 1; b < kFactors; ++b)
      for (int i = 0; i < n[a]; ++i)
        for (int j = 0; j < n[b]; ++j)
          EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [&](const Choice& c) { return c[a] == i && c[b] == j; }));
  EXPECT_LT(rows.size(), 60u);
}

}  // namespace bdpt::transport_cover_test
