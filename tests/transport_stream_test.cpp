// No two subpaths of a render draw the same numbers.
#include "rendering.h"

#include <set>

namespace bdpt::transport_stream_test {

using namespace rendering;

TEST(TransportStream, EverySubpathHasNumbersOfItsOwn) {
  const ScenePointer scene = scenes::room({}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), 12, 10);
  for (int groups : {1, 3}) {
    FilmDesc desc = film_desc(12, 10);
    desc.groups = groups;
    Film film(desc, nullptr);
    const Engine engine(*scene, *camera, film, options_for(), 5), other(*scene, *camera, film, options_for(), 6);
    std::set<std::pair<uint64_t, uint32_t>> seen;
    std::set<uint64_t> eye, light;
    size_t count = 0;
    for (uint64_t pass = 0; pass < 30; ++pass)
      for (uint64_t number = 0; number < engine.samples_per_pass(); ++number)
        for (const Engine* e : {&engine, &other}) {
          const Stream a = e->eye_stream(pass, number), b = e->light_stream(pass, number);
          seen.insert({a.scramble, a.index});
          seen.insert({b.scramble, b.index});
          eye.insert(a.scramble);
          light.insert(b.scramble);
          count += 2;
        }
    EXPECT_EQ(seen.size(), count);
    // An eye subpath's sequence is its pixel's and group's; a light subpath's is its group's.
    EXPECT_EQ(eye.size(), size_t(2 * groups) * 120);
    EXPECT_EQ(light.size(), size_t(2 * groups));
    size_t shared = 0;
    for (uint64_t scramble : light) shared += eye.count(scramble);
    EXPECT_EQ(shared, 0u);
  }
}

// Groups are independent, and within one the points of a sequence follow each other without a gap.
TEST(TransportStream, PassesOfAGroupFollowEachOther) {
  const ScenePointer scene = scenes::room({}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), 4, 3);
  FilmDesc desc = film_desc(4, 3);
  desc.groups = 3;
  Film film(desc, nullptr);
  const Engine engine(*scene, *camera, film, options_for(), 5);
  for (uint64_t group = 0; group < 3; ++group)
    for (uint64_t i = 0; i < 10; ++i) {
      ASSERT_EQ(engine.eye_stream(group + 3 * i, 7).index, i);
      ASSERT_EQ(engine.light_stream(group + 3 * i, 7).index, i * 12 + 7);
      ASSERT_EQ(engine.eye_stream(group + 3 * i, 7).scramble, engine.eye_stream(group, 7).scramble);
      ASSERT_EQ(engine.light_stream(group + 3 * i, 7).scramble, engine.light_stream(group, 3).scramble);
    }
  // Beyond 2^32 points a new sequence begins.
  const uint64_t far = 3 * (uint64_t(1) << 33);
  EXPECT_NE(engine.eye_stream(far, 7).scramble, engine.eye_stream(0, 7).scramble);
  EXPECT_NE(engine.light_stream(far, 7).scramble, engine.light_stream(0, 7).scramble);
}

}  // namespace bdpt::transport_stream_test
