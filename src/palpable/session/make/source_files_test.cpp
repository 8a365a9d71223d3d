// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/source_files.hpp"

#include "palpable/core/files/atomic_file.hpp"

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::session {
namespace {

using testing::HasSubstr;

class SourceFiles : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const auto file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    EXPECT_TRUE(write_file_atomically(file, std::as_bytes(std::span(text))));
    return file;
  }

  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "palpable-sources-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(SourceFiles, HashesAreThoseOfTheStandard) {
  // FIPS 180-4's examples, and a file longer than a block that is read.
  EXPECT_EQ(*sha256_of(write("empty", ""), {}),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(*sha256_of(write("abc", "abc"), {}),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(*sha256_of(write("million", std::string(1000000, 'a')), {}),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_F(SourceFiles, WhatIsNoFileIsRefused) {
  EXPECT_EQ(sha256_of(folder_ / "missing", {}).error().code, ErrorCode::invalid_input);
  EXPECT_EQ(sha256_of("/dev/zero", {}).error().code, ErrorCode::invalid_input);
  std::atomic<bool> cancelled = true;
  Work work;
  work.cancel = &cancelled;
  EXPECT_EQ(sha256_of(write("abc", "abc"), work).error().code, ErrorCode::interrupted);
}

TEST_F(SourceFiles, AreFoundUnderTheirNameOrBesideTheScene) {
  const auto there = write("pictures/left.png", "left");
  const auto sources = source_files({there}, {});
  ASSERT_TRUE(sources);
  EXPECT_EQ(sources->front().bytes, 4U);
  const auto scene = folder_ / "scenes/room.palp";
  EXPECT_EQ(find_source_files(*sources, scene, {})->front(), there);
  std::filesystem::remove(there);
  const auto missing = find_source_files(*sources, scene, {});
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, HasSubstr("is missing"));
  EXPECT_EQ(missing.error().place, there.string());
  const auto beside = write("scenes/left.png", "left");
  EXPECT_EQ(find_source_files(*sources, scene, {})->front(), beside);
  write("scenes/left.png", "tfel");
  const auto changed = find_source_files(*sources, scene, {});
  ASSERT_FALSE(changed);
  EXPECT_THAT(changed.error().message, HasSubstr("has another content"));
}

}  // namespace
}  // namespace palpable::session
