// What the tests of `bdpt bake` share: a folder, and the command in it.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "commands.h"
#include "temp_folder.h"

namespace bdpt_tool {

class BakeFixture : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(file(name)) << text; }

  // `bdpt bake` of this scene with these arguments; what it says to stderr is in error_.
  int run(const std::string& scene, const std::string& output, const std::vector<std::string>& arguments) {
    std::vector<std::string> all = {"bdpt", "bake", file(scene), "-o", file(output)};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& a : all) argv.push_back(a.data());
    testing::internal::CaptureStderr();
    const int code = run_program(int(argv.size()), argv.data());
    error_ = testing::internal::GetCapturedStderr();
    return code;
  }

  bdpt::TempFolder folder_;
  std::string error_;
};

}  // namespace bdpt_tool
