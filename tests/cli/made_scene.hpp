// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "program.hpp"
#include "test_pictures.hpp"
#include <gtest/gtest.h>

namespace palpable::test {

/// A folder with a pair of pictures and the scene a.palp that was made of it, for all tests of a suite.
class MadeScene : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::string name = (std::filesystem::temp_directory_path() / "palpable-scene-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
    write_pair(folder, textured_pair());
    made = palpable({"make", in("left.png"), in("right.png"), "-o", in("a.palp"), "--json"});
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder); }
  void SetUp() override { ASSERT_EQ(made.exit_code, 0) << made.err; }
  static std::string in(const std::string& name) { return folder + "/" + name; }

  static inline std::string folder;
  static inline Outcome made;
};

}  // namespace palpable::test
