// The syntax of --techniques.
//
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "error.h"
#include "technique_mask.h"

namespace bdpt_tool::tool_technique_mask_test {

TEST(ToolTechniqueMask, AllAllowsEverything) {
  for (std::uint32_t bits : parse_technique_mask("all")) EXPECT_EQ(bits, ~0u);
}

TEST(ToolTechniqueMask, ComparisonsSelectRowsAndColumns) {
  const TechniqueMask path = parse_technique_mask("s<=1");
  EXPECT_EQ(path[0], ~0u);
  EXPECT_EQ(path[1], ~0u);
  EXPECT_EQ(path[2], 0u);
  for (std::uint32_t bits : parse_technique_mask("t<=1")) EXPECT_EQ(bits, 3u);
  for (std::uint32_t bits : parse_technique_mask("t>30")) EXPECT_EQ(bits, 1u << 31);
  EXPECT_EQ(parse_technique_mask("s=31")[31], ~0u);
}

TEST(ToolTechniqueMask, PairsAreSingleTechniques) {
  const TechniqueMask mask = parse_technique_mask("2x3");
  for (std::uint32_t s = 0; s < 32; ++s) {
    for (std::uint32_t t = 0; t < 32; ++t) EXPECT_EQ(allows(mask, s, t), s == 2 && t == 3);
  }
}

TEST(ToolTechniqueMask, CommaIsUnionAndAmpersandBindsTighter) {
  const TechniqueMask mask = parse_technique_mask("s=1 & t=2, 0x5");
  EXPECT_EQ(mask[0], 1u << 5);
  EXPECT_EQ(mask[1], 1u << 2);
  EXPECT_EQ(mask[2], 0u);
}

TEST(ToolTechniqueMask, ThirtyOneStandsForAllBeyond) { EXPECT_TRUE(allows(parse_technique_mask("31x31"), 40, 1000)); }

TEST(ToolTechniqueMask, WhatIsNotInTheSyntaxIsAUsageError) {
  for (const char* text : {"", ",", "s", "s<", "s<=32", "s<=-1", "u<=1", "2x", "x2", "2x2x2", "s<=1&", "s=<1",
                           "s<=1;t=2", "all&", "t=1.5", "99999999999x1"}) {
    try {
      parse_technique_mask(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage) << text;
    }
  }
}

TEST(ToolTechniqueMask, AMaskThatAllowsNothingIsAnError) { EXPECT_THROW(parse_technique_mask("s=1&s=2"), Error); }

}  // namespace bdpt_tool::tool_technique_mask_test
