// `bdpt bake --what probes` and `--what points`: where, what, in which file; and lists of points with mistakes.
//
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "bake_fixture.h"
#include "image.h"
#include "point_list.h"

namespace bdpt_tool::tool_bake_points_test {

class ToolBakePoints : public BakeFixture {
 protected:
  // A black floor, 4 x 4, at y = 0 and a lamp of radiance 1, 1 x 1, at y = 1, that looks down.
  void SetUp() override {
    write("scene.pbrt", R"(Camera "perspective"
WorldBegin
Material "diffuse" "rgb reflectance" [0 0 0]
Shape "trianglemesh" "point3 P" [-2 0 2  2 0 2  2 0 -2  -2 0 -2] "integer indices" [0 1 2 0 2 3]
AreaLightSource "diffuse" "rgb L" [1 1 1]
Shape "trianglemesh" "point3 P" [-.5 1 -.5  .5 1 -.5  .5 1 .5  -.5 1 .5] "integer indices" [0 1 2 0 2 3]
)");
  }
  std::string text(const std::string& name) const {
    std::ostringstream all;
    all << std::ifstream(file(name)).rdbuf();
    return all.str();
  }

  int bake(const std::string& output, const std::vector<std::string>& arguments) {
    return run("scene.pbrt", output, arguments);
  }
  // The lines of a CSV file but the first.
  std::vector<std::vector<double>> rows(const std::string& name) const {
    std::ifstream csv(file(name));
    std::vector<std::vector<double>> rows;
    std::string line;
    for (std::getline(csv, line); std::getline(csv, line);) rows.push_back(parse_numbers(line));
    return rows;
  }
};

// A square seen from half its side away is a face of a cube seen from the middle.
TEST_F(ToolBakePoints, LightOfASquareLampIsThatOfTheFormula) {
  const double pi = std::numbers::pi;
  write("up.txt", "x y z nx ny nz\n0 .5 0  0 1 0\n\n0, 0.5, 0, 0, -2, 0 # away\n");
  ASSERT_EQ(0, bake("up.csv", {"--what", "points", "--points", file("up.txt"), "--spp", "4096"})) << error_;
  EXPECT_EQ(0u, text("up.csv").find("x,y,z,nx,ny,nz,irradiance.R,irradiance.G,irradiance.B\n"));
  const auto up = rows("up.csv");
  ASSERT_EQ(2u, up.size());
  ASSERT_EQ(9u, up[0].size());
  EXPECT_NEAR(4 * std::sqrt(0.5) * std::atan(std::sqrt(0.5)), up[0][6], 0.01);
  EXPECT_EQ(-2, up[1][4]);
  EXPECT_EQ(0, up[1][6]);

  write("all.txt", "0 .5 0\n");
  ASSERT_EQ(0, bake("all.csv", {"--what", "points", "--points", file("all.txt"), "--spp", "4096"})) << error_;
  EXPECT_EQ(0u, text("all.csv").find("x,y,z,fluence.R"));
  EXPECT_NEAR(2 * pi / 3, rows("all.csv")[0][3], 0.02);
}

TEST_F(ToolBakePoints, ProbesStandAtTheCentresOfCells) {
  const std::vector<std::string> how = {"--what", "probes", "--grid", "2,1,3", "--box", "-2,0,-3,2,1,3", "--spp", "4"};
  ASSERT_EQ(0, bake("a.csv", how)) << error_;
  const auto grid = rows("a.csv");
  ASSERT_EQ(6u, grid.size());
  for (std::size_t i = 0; i < 6; ++i) {
    ASSERT_EQ(3u + 27u, grid[i].size());
    EXPECT_EQ(i % 2 ? 1 : -1, grid[i][0]);
    EXPECT_EQ(0.5, grid[i][1]);
    EXPECT_EQ(double(i / 2) * 2 - 2, grid[i][2]);
  }
  // The same numbers in the other files.
  ASSERT_EQ(0, bake("a.exr", how)) << error_;
  const auto layers = read_exr(file("a.exr"));
  ASSERT_EQ(11u, layers.size());  // the main one, nine, position
  const Image& image = layers.at("radiance_sh_8");
  EXPECT_EQ(2u, image.width);
  EXPECT_EQ(3u, image.height);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(image.pixels[3 * i + 1], float(grid[i][3 + 24 + 1]));
    EXPECT_EQ(layers.at("position").pixels[3 * i + 2], float(grid[i][2]));
  }
  ASSERT_EQ(0, bake("a.json", how)) << error_;
  EXPECT_EQ(0u,
            text("a.json").find(R"({"grid": [2, 1, 3], "points": [{"position": [-1, 0.5, -2], "radiance_sh_0": [)"));
}

TEST_F(ToolBakePoints, WithoutABoxProbesFillTheScene) {
  ASSERT_EQ(0, bake("a.csv", {"--what", "probes", "--grid", "1,2,4", "--spp", "1", "--outputs", "fluence"})) << error_;
  const auto grid = rows("a.csv");
  ASSERT_EQ(8u, grid.size());
  EXPECT_NEAR(0, grid[0][0], 1e-6);
  EXPECT_NEAR(0.25, grid[0][1], 1e-6);
  EXPECT_NEAR(-1.5, grid[0][2], 1e-6);
}

TEST_F(ToolBakePoints, HalvesMakeTheWhole) {
  const auto probes = [&](const std::string& output, std::vector<std::string> more) {
    more.insert(more.begin(), {"--what", "probes", "--grid", "3,2,1"});
    return bake(output, more);
  };
  ASSERT_EQ(0, probes("whole.csv", {"--spp", "16"})) << error_;
  ASSERT_EQ(0, probes("half.csv", {"--spp", "8", "--film", file("a.film")})) << error_;
  ASSERT_EQ(0, probes("rest.csv", {"--spp", "16", "--film", file("a.film"), "--resume"})) << error_;
  EXPECT_NE(text("whole.csv"), text("half.csv"));
  EXPECT_EQ(text("whole.csv"), text("rest.csv"));
}

TEST_F(ToolBakePoints, MistakesInListsAreToldWithTheLine) {
  const auto refused = [&](const std::string& points, const std::string& message) {
    write("p.txt", points);
    EXPECT_EQ(3, bake("a.csv", {"--what", "points", "--points", file("p.txt"), "--spp", "1"})) << points;
    EXPECT_NE(std::string::npos, error_.find(file("p.txt") + message)) << error_;
    EXPECT_FALSE(std::filesystem::exists(file("a.csv")));
  };
  refused("", ": has no points");
  refused("x y z\n# none\n", ": has no points");
  refused("0 0 0\n\n1 2\n", ":3: 2 numbers; write x y z, or x y z nx ny nz");
  refused("0 0 0\n1 2 three\n", ":2: 'three' is no number");
  refused("0 0 nan\n", ":1: 'nan' is no number");
  refused("0 0 1e99\n", ":1: '1e99' is no number");
  refused("x y z\nx y z\n", ":2: 'x' is no number");
  refused("0 0 0 0 1 0\n0 0 0\n", ":2: points with a normal and points without");
  refused("0 0 0 0 0 0\n", ":1: a normal of length zero");
  EXPECT_EQ(3, bake("a.csv", {"--what", "points", "--points", file("none.txt")}));
  EXPECT_NE(std::string::npos, error_.find("none.txt: cannot be read")) << error_;
  write("n.txt", "0 0 0 0 1 0\n");
  EXPECT_EQ(3, bake("a.csv", {"--what", "probes", "--points", file("n.txt")}));
  EXPECT_NE(std::string::npos, error_.find("--what points")) << error_;
  write("p.txt", "0 .5 0\n");
  EXPECT_EQ(3, bake("a.csv", {"--what", "points", "--points", file("p.txt"), "--outputs", "e", "--spp", "1"}));
}

TEST_F(ToolBakePoints, OptionsThatDoNotFitAreTold) {
  const auto refused = [&](const std::string& output, const std::vector<std::string>& arguments,
                           const std::string& text) {
    EXPECT_EQ(2, bake(output, arguments)) << error_;
    EXPECT_NE(std::string::npos, error_.find(text)) << error_;
    EXPECT_FALSE(std::filesystem::exists(file(output)));
  };
  write("p.txt", "0 .5 0\n");
  refused("a.csv", {"--what", "probes"}, "--grid NX,NY,NZ");
  refused("a.csv", {"--what", "points"}, "--points FILE");
  refused("a.csv", {"--what", "points", "--grid", "1,1,1"}, "--points FILE");
  refused("a.csv", {"--what", "probes", "--grid", "1,1,1", "--points", file("p.txt")}, "one of them");
  refused("a.csv", {"--what", "probes", "--points", file("p.txt"), "--box", "0,0,0,1,1,1"}, "--box needs --grid");
  refused("a.csv", {"--what", "probes", "--grid", "1,1"}, "--grid: give 3 numbers");
  refused("a.csv", {"--what", "probes", "--grid", "1,1,many"}, "--grid: 'many'");
  refused("a.csv", {"--what", "probes", "--grid", "1,1.5,1"}, "whole numbers");
  refused("a.csv", {"--what", "probes", "--grid", "0,1,1"}, "from 1 to 65536");
  refused("a.csv", {"--what", "probes", "--grid", "60000,60000,1"}, "more than");
  refused("a.csv", {"--what", "probes", "--grid", "1,1,1", "--box", "0,0,0,1,1,-1"}, "--box: give x0");
  refused("a.csv", {"--what", "probes", "--grid", "1,1,1", "--resolution", "8"}, "--resolution is for lightmaps");
  refused("a.txt", {"--what", "probes", "--grid", "1,1,1"}, ".exr, .json or .csv");
  refused("a.csv", {"--what", "lamps"}, "--what");
  refused("a.exr", {"--grid", "1,1,1"}, "--grid needs --what probes");
  refused("a.csv", {}, "must end in .exr");
}

}  // namespace bdpt_tool::tool_bake_points_test
