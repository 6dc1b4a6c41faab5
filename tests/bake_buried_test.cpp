// What is buried is not measured, by any technique: floors that run on under walls.
#include "baking.h"

namespace bdpt::bake_buried_test {

using namespace baking;
using scenes::Builder;

Material one_sided(float reflectance) {
  Material m = scenes::diffuse(reflectance);
  m.one_sided = true;
  return m;
}

BurialDesc looked_for() {
  BurialDesc burial;
  burial.rays = 16;
  return burial;
}

// A floor, 2 x 2, and the square of it on which the house stands.
constexpr float kWall = 0.3125f;  // with 8 texels a side, a quarter of a texel: between cells

scenes::MeshData floor_mesh() {
  return scenes::unwrapped(scenes::quad(Vec3(-1, 0, 1), Vec3(1, 0, 1), Vec3(1, 0, -1), Vec3(-1, 0, -1)), 1, 0);
}
scenes::MeshData house_mesh() { return scenes::box(Vec3(-1.5f, -0.1f, -1.5f), Vec3(kWall, 0.5f, 1.5f), false); }

// A sky, a lamp in the open, and a lamp within the house that lights the buried floor brightly.
ScenePointer house(bool with_lamp_inside) {
  Builder b;
  b.add(floor_mesh(), one_sided(0.5f));
  b.add(house_mesh(), one_sided(0.6f));
  b.add(scenes::quad(Vec3(0.4f, 0.9f, -0.6f), Vec3(0.9f, 0.9f, -0.6f), Vec3(0.9f, 0.9f, 0.1f), Vec3(0.4f, 0.9f, 0.1f)),
        scenes::emitter(Rgb(4)));
  if (with_lamp_inside)
    b.add(scenes::quad(Vec3(-0.3f, 0.4f, -0.1f), Vec3(0.1f, 0.4f, -0.1f), Vec3(0.1f, 0.4f, 0.1f),
                       Vec3(-0.3f, 0.4f, 0.1f)),
          scenes::emitter(Rgb(400)));
  b.environment(Rgb(1));
  return b.build();
}

TEST(BakeBuried, AreasAreThoseOfTheCellsThatAreOpen) {
  const auto map = lightmap(house(false), 8, {placed(0)}, {OutputDesc{}}, looked_for());
  const TexelMap& texels = map->texels();
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const double open = x < 5 ? 0 : x == 5 ? 0.75 : 1;
      EXPECT_NEAR(texels.coverage(x, y), open, 1e-6) << x << ", " << y;
      EXPECT_NEAR(texels.area(x, y), open / 16, 1e-6) << x << ", " << y;
      EXPECT_NEAR(texels.buried(x, y), 1 - open, 1e-6) << x << ", " << y;
      EXPECT_EQ(texels.number(x, y) < 0, open == 0);
    }
  EXPECT_EQ(texels.report().texels, 24u);
  EXPECT_EQ(texels.report().buried, 40u);
  EXPECT_NEAR(texels.report().area, 2 * (1 - kWall), 1e-5);
  EXPECT_NEAR(texels.report().area_buried, 2 * (1 + kWall), 1e-5);
}

TEST(BakeBuried, WithoutBacksNothingIs) {
  Builder b;
  b.add(floor_mesh(), one_sided(0.5f));
  b.add(house_mesh(), scenes::diffuse(0.6f));  // two-sided
  b.environment(Rgb(1));
  const ScenePointer scene = b.build();
  EXPECT_EQ(lightmap(scene, 8, {placed(0)}, {OutputDesc{}}, looked_for())->texels().report().texels, 64u);
  BurialDesc all = looked_for();
  all.all_backs = true;
  EXPECT_EQ(lightmap(scene, 8, {placed(0)}, {OutputDesc{}}, all)->texels().report().texels, 24u);
  Builder glass;
  glass.add(floor_mesh(), one_sided(0.5f));
  glass.add(house_mesh(), scenes::dielectric(1.5f));
  glass.environment(Rgb(1));
  EXPECT_EQ(lightmap(glass.build(), 8, {placed(0)}, {OutputDesc{}}, all)->texels().report().texels, 64u);
}

// The part of the rays that meets backs decides: a roof, one-sided, its back down, over a floor that sees the sky
// beside it. Points in its middle see it alone.
TEST(BakeBuried, TheToleranceIsAPartOfTheRays) {
  Builder b;
  b.add(floor_mesh(), one_sided(0.5f));
  b.add(scenes::quad(Vec3(-1, 0.5f, 1), Vec3(1, 0.5f, 1), Vec3(1, 0.5f, -1), Vec3(-1, 0.5f, -1)), one_sided(0.5f));
  b.environment(Rgb(1));
  const ScenePointer scene = b.build();
  // Form factors of the roof, from cell to cell: 0.75 in the middle, 0.24 in the corners.
  const auto open = [&](float tolerance) {
    BurialDesc burial{64, tolerance};
    return lightmap(scene, 8, {placed(0)}, {OutputDesc{}}, burial)->texels().report().area;
  };
  EXPECT_NEAR(open(0.99f), 4, 1e-5);
  EXPECT_EQ(open(0.05f), 0);
  const double half = open(0.5f), more = open(0.7f);
  EXPECT_GT(half, 0.2);
  EXPECT_LT(half, more);
  EXPECT_LT(more, 4);
}

// The same floor, cut at the wall.
TEST(BakeBuried, EveryTechniqueMeasuresWhatIsNotBuried) {
  const ScenePointer scene = house(true);
  const SensorPointer sensor = lightmap(scene, 8, {placed(0)}, {OutputDesc{}}, looked_for());
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (const Way& way : ways(3)) {
    Effort effort;
    effort.seeds = 24, effort.side = 4, effort.passes = way.name == "s = 0" ? 512 : 256;
    effort.first_seed = means.size();
    means.push_back(block_means(scene, sensor, way.options, effort));
    names.push_back(way.name);
  }
  expect_all_same(means, names);
}

TEST(BakeBuried, TheMeanIsThatOfAFloorCutAtTheWall) {
  const ScenePointer scene = house(true);
  const auto whole = lightmap(scene, 8, {placed(0)}, {OutputDesc{}}, looked_for());
  Builder b;  // the floor outside alone, at its place in the atlas
  scenes::MeshData cut = scenes::quad(Vec3(kWall, 0, 1), Vec3(1, 0, 1), Vec3(1, 0, -1), Vec3(kWall, 0, -1));
  const float left = (1 + kWall) / 2;
  cut.lightmap_uv = {Vec2(left, 0), Vec2(1, 0), Vec2(1, 1), Vec2(left, 1)};
  b.add(cut, one_sided(0.5f));
  b.add(house_mesh(), one_sided(0.6f));
  b.add(scenes::quad(Vec3(0.4f, 0.9f, -0.6f), Vec3(0.9f, 0.9f, -0.6f), Vec3(0.9f, 0.9f, 0.1f), Vec3(0.4f, 0.9f, 0.1f)),
        scenes::emitter(Rgb(4)));
  b.environment(Rgb(1));
  const ScenePointer alone = b.build();
  const auto part = lightmap(alone, 8);
  EXPECT_NEAR(part->texels().report().area, whole->texels().report().area, 1e-5);
  const auto column = [](const ScenePointer& s, const SensorPointer& sensor, uint64_t seed) {
    BlockMeans means;
    means.values.resize(9);
    for (uint64_t i = 0; i < 24; ++i) {
      const std::vector<float> map = read(*render(s, sensor, options_for({}, 3), 256, 100 * seed + i).film);
      double sum = 0;
      for (size_t y = 0; y < 8; ++y) {
        means.values[y].add(double(map[3 * (8 * y + 5)]));  // the column that the wall crosses
        for (size_t x = 0; x < 8; ++x)
          sum += double(map[3 * (8 * y + x)]) *
                 double(static_cast<const Lightmap&>(*sensor).texels().area(int(x), int(y)));
      }
      means.values[8].add(sum);
    }
    return means;
  };
  const BlockMeans a = column(scene, whole, 1), c = column(alone, part, 2);
  EXPECT_LT(a.values[8].standard_error(), 5e-3 * a.values[8].mean());
  expect_same(a, c, 1, "under the wall and cut");
}

// The flux of a sky of radiance 1 on what a wall leaves open, E = pi at a point that sees no wall: here all of the
// floor outside of a flat box, whose walls are black and low.
TEST(BakeBuried, FluxIsThatOnWhatIsOpen) {
  Builder b;
  b.add(floor_mesh(), one_sided(0));
  b.add(scenes::box(Vec3(-2, -0.1f, -2), Vec3(kWall, 1e-4f, 2), false), one_sided(0));
  b.environment(Rgb(1));
  const ScenePointer scene = b.build();
  const auto map = lightmap(scene, 8, {placed(0)}, {OutputDesc{}}, looked_for());
  for (const Way& way : ways(1)) {
    if (way.name == "combinatorial" || way.name == "t = 1") continue;  // t = 1: direct lighting alone, as s = 1
    Estimate flux;
    for (uint64_t seed = 0; seed < 16; ++seed) {
      const std::vector<float> texels =
          read(*render(scene, map, way.options, way.name == "t = 0" ? 1024 : 64, seed).film);
      double sum = 0;
      for (size_t y = 0; y < 8; ++y)
        for (size_t x = 0; x < 8; ++x)
          sum += double(texels[3 * (8 * y + x)]) * double(map->texels().area(int(x), int(y)));
      flux.add(sum);
    }
    const double expected = M_PI * 2 * (1 - double(kWall));
    expect_value(flux, expected, 8, way.name, 3e-4 * expected);
    EXPECT_LT(flux.standard_error(), 0.02 * expected) << way.name;
  }
}

// A closed mesh whose inside is mapped is a room; seen from outside through its own walls it is buried whole.
TEST(BakeBuried, ARoomAndItsOutside) {
  Builder b;
  b.add(scenes::unwrapped(scenes::box(Vec3(-1), Vec3(1), true), 3, 0.02f), one_sided(0.5f));
  b.environment(Rgb(1));
  const ScenePointer scene = b.build();
  const auto inside = lightmap(scene, 12, {placed(0)}, {OutputDesc{}}, looked_for());
  EXPECT_EQ(inside->texels().report().buried, 0u);
  EXPECT_NEAR(inside->texels().report().area_buried, 0, 1e-12);
  Builder closed;
  closed.add(scenes::unwrapped(scenes::box(Vec3(-1), Vec3(1), false), 3, 0.02f), one_sided(0.5f));
  closed.environment(Rgb(1));
  LightmapInstance back = placed(0);
  back.flip = true;  // looks into the closed box
  const ScenePointer box = closed.build();
  const auto buried = lightmap(box, 12, {back}, {OutputDesc{}}, looked_for());
  EXPECT_EQ(buried->texels().report().texels, 0u);
  EXPECT_EQ(buried->texels().report().buried, lightmap(box, 12, {back})->texels().report().texels);
  EXPECT_NEAR(buried->texels().report().area_buried, 24, 1e-4);
  const auto outside = lightmap(box, 12, {placed(0)}, {OutputDesc{}}, looked_for());
  EXPECT_EQ(outside->texels().report().buried, 0u);
}

// A wall across the texels at an angle: the open cells are those whose own middle is outside, and starts lie in them
// evenly.
TEST(BakeBuried, StartsLieInOpenCellsEvenly) {
  Builder b;
  b.add(floor_mesh(), one_sided(0.5f));
  const Transform turned{{0.8f, 0, -0.6f, -0.7f, 0, 1, 0, 0, 0.6f, 0, 0.8f, 0}};
  b.add(scenes::box(Vec3(-1.5f, -0.1f, -2), Vec3(0.6f, 0.5f, 2), false), one_sided(0.6f), turned);
  b.environment(Rgb(1));
  const auto map = lightmap(b.build(), 4, {placed(0)}, {OutputDesc{}}, looked_for());
  const auto inside = [](double x, double z) { return 0.8 * (x + 0.7) + 0.6 * z < 0.6; };
  statistics::Uniform uniform(3);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      std::vector<double> open(64), found(64);
      double cells = 0;
      for (int i = 0; i < 64; ++i) {
        const double cx = x + (i % 8 + 0.5) / 8, cy = y + (i / 8 + 0.5) / 8;  // row 0 is v = 1, z = -1
        const bool is_open = !inside(cx / 2 - 1, cy / 2 - 1);
        open[size_t(i)] = is_open, cells += is_open;
      }
      EXPECT_NEAR(map->texels().coverage(x, y), cells / 64, 0.03) << x << ", " << y;
      if (map->texels().number(x, y) < 0) continue;
      for (int n = 0; n < 20000; ++n) {
        float u[4];
        for (float& v : u) v = uniform();
        const EyeStart s = map->start_at(x, y, u);
        const int cx = int((double(s.p.x) + 1) * 16) - 8 * x, cy = int((double(s.p.z) + 1) * 16) - 8 * y;
        ASSERT_TRUE(cx >= 0 && cx < 8 && cy >= 0 && cy < 8);
        found[size_t(8 * cy + cx)] += 1;
      }
      for (double& v : open) v *= 20000 / cells;
      int strange = 0;  // cells that the diagonal of the floor cuts have two middles
      for (size_t i = 0; i < 64; ++i) strange += (open[i] > 0) != (found[i] > 0);
      EXPECT_LE(strange, 2) << x << ", " << y;
      if (strange > 0) continue;
      EXPECT_GT(statistics::chi_square_test(found, open), statistics::kSignificance) << x << ", " << y;
    }
}

// A film of a part of the map has the same cells, areas and starts.
TEST(BakeBuried, APartHasTheCellsOfTheWhole) {
  Builder b;
  b.add(floor_mesh(), one_sided(0.5f));
  const Transform turned{{0.8f, 0, -0.6f, -0.7f, 0, 1, 0, 0, 0.6f, 0, 0.8f, 0}};
  b.add(scenes::box(Vec3(-1.5f, -0.1f, -2), Vec3(0.6f, 0.5f, 2), false), one_sided(0.6f), turned);
  b.environment(Rgb(1));
  const ScenePointer scene = b.build();
  const auto whole = lightmap(scene, 8, {placed(0)}, {OutputDesc{}}, looked_for());
  LightmapDesc desc{{placed(0)}, {8, 8, 1}, {1, 3, 7, 8}};
  desc.burial = looked_for();
  desc.film_of_rect = true;
  const Lightmap part(scene, desc, {OutputDesc{}}, nullptr);
  const TexelMap &all = whole->texels(), &some = part.texels();
  ASSERT_EQ(some.width(), 6);
  ASSERT_EQ(some.height(), 5);
  uint64_t partly = 0;
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 6; ++x) {
      EXPECT_EQ(some.area(x, y), all.area(x + 1, y + 3));
      EXPECT_EQ(some.coverage(x, y), all.coverage(x + 1, y + 3));
      EXPECT_EQ(some.buried(x, y), all.buried(x + 1, y + 3));
      EXPECT_EQ(part.place(x, y), whole->place(x + 1, y + 3));
      if (some.number(x, y) < 0) continue;
      partly += some.buried(x, y) > 0;
      for (const float u : {0.1f, 0.5f, 0.99f}) {
        const float numbers[4] = {u, 1 - u, 0.3f, 0.6f};
        const EyeStart s = part.start_at(x, y, numbers), t = whole->start_at(x + 1, y + 3, numbers);
        EXPECT_EQ(s.p, t.p);
      }
    }
  EXPECT_GT(partly, 3u);
}

}  // namespace bdpt::bake_buried_test
