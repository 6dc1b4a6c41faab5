// IES files: what is read of them, and that nothing broken gets through.
//
// SPDX-License-Identifier: Apache-2.0
#include "ies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "error.h"

namespace bdpt_tool::tool_ies_test {

std::string ies(const std::string& horizontal, const std::string& rows, const std::string& tilt = "NONE",
                const std::string& type = "1") {
  const auto count = [](const std::string& text) {
    return std::to_string(1 + std::count(text.begin(), text.end(), ' '));
  };
  return "IESNA:LM-63-1995\r\n[TEST] none\r\nTILT=" + tilt + "\r\n1 1000 2 3 " + count(horizontal) + " " + type +
         " 2 0 0 0\r\n0.5 1 20\r\n0 45 90\r\n" + horizontal + "\r\n" + rows;
}

std::string error_of(const std::string& text) {
  try {
    parse_ies(text, "lamp.ies");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ToolIes, CandelaAreMultiplied) {
  const Luminaire l = parse_ies(ies("0", "10 20,+3e1"), "lamp.ies");
  EXPECT_EQ(l.vertical_angles, (std::vector<float>{0, 45, 90}));
  EXPECT_EQ(l.horizontal_angles, std::vector<float>{0});
  EXPECT_EQ(l.candela, (std::vector<float>{10, 20, 30}));
}

TEST(ToolIes, TiltIsSkipped) {
  EXPECT_EQ(parse_ies(ies("0", "10 20 30", "INCLUDE\r\n1\r\n2\r\n0 90\r\n1 0.5"), "lamp.ies").candela.size(), 3u);
  EXPECT_NE(error_of(ies("0", "10 20 30", "other.tlt")).find("other.tlt"), std::string::npos);
}

TEST(ToolIes, AnglesAreCompleted) {
  const Luminaire open = parse_ies(ies("0 120 240", "1 1 1 2 2 2 3 3 3"), "lamp.ies");
  EXPECT_EQ(open.horizontal_angles, (std::vector<float>{0, 120, 240, 360}));
  EXPECT_EQ(open.candela[9], open.candela[0]);
  const Luminaire side = parse_ies(ies("90 180 200 270", "1 1 1 2 2 2 3 3 3 4 4 4"), "lamp.ies");
  EXPECT_EQ(side.horizontal_angles, (std::vector<float>{0, 90, 180, 200, 270, 340, 360}));
  std::vector<float> firsts;
  for (std::size_t i = 0; i < side.candela.size(); i += 3) firsts.push_back(side.candela[i]);
  EXPECT_EQ(firsts, (std::vector<float>{2, 1, 2, 3, 4, 3, 2}));
}

TEST(ToolIes, WhatIsBrokenIsRefusedWithItsLine) {
  EXPECT_NE(error_of("IESNA91\n[TEST]\n").find("lamp.ies:2: "), std::string::npos) << error_of("IESNA91\n[TEST]\n");
  EXPECT_NE(error_of(ies("0", "10 20")).find("candela"), std::string::npos);
  EXPECT_NE(error_of(ies("0", "10 x 30")).find("lamp.ies:8: "), std::string::npos) << error_of(ies("0", "10 x 30"));
  EXPECT_NE(error_of(ies("0", "10 -1 30")), "");
  EXPECT_NE(error_of(ies("0", "10 nan 30")), "");
  EXPECT_NE(error_of(ies("0 70", "1 1 1 2 2 2")).find("70"), std::string::npos);
  EXPECT_NE(error_of(ies("0 180 90", "1 1 1 2 2 2 3 3 3")), "");
  EXPECT_NE(error_of(ies("0", "1 1 1", "NONE", "2")).find("type B"), std::string::npos);
  const std::string whole = ies("0 90", "1 1 1 2 2 2");
  for (std::size_t size = 0; size + 12 < whole.size(); ++size) EXPECT_NE(error_of(whole.substr(0, size)), "") << size;
}

// The lumens of the lamp are not all that leaves the luminaire, but most.
TEST(ToolIes, AFileOfALaboratory) {
  const std::string path = std::string(BDPT_SHARED_DIR) + "/scenes/ies/ASA_15M_R2.ies";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path;
  const Luminaire l = read_ies(path);
  ASSERT_EQ(l.vertical_angles.size(), 37u);
  ASSERT_EQ(l.horizontal_angles.size(), 73u);
  EXPECT_EQ(l.candela[0], 1666);
  double lumens = 0;
  for (std::size_t i = 0; i + 1 < 73; ++i)
    for (std::size_t k = 0; k + 1 < 37; ++k) {
      const double mean = (l.candela[i * 37 + k] + l.candela[i * 37 + k + 1] + l.candela[(i + 1) * 37 + k] +
                           l.candela[(i + 1) * 37 + k + 1]) /
                          4.0;
      const auto cosine = [&](std::size_t j) { return std::cos(l.vertical_angles[j] * M_PI / 180); };
      lumens +=
          2 * mean * (cosine(k) - cosine(k + 1)) * (l.horizontal_angles[i + 1] - l.horizontal_angles[i]) * M_PI / 180;
    }
  EXPECT_GT(lumens, 0.6 * 13000);
  EXPECT_LT(lumens, 13000);
}

}  // namespace bdpt_tool::tool_ies_test
