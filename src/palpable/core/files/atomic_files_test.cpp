// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/atomic_files.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"

#include <filesystem>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

namespace palpable {
namespace {

namespace fs = std::filesystem;

class SomeFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / (std::string("palpable-files-") +
                                              testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::ptrdiff_t entries() const { return std::distance(fs::directory_iterator(folder_), {}); }
  fs::path folder_;
};

TEST_F(SomeFiles, AppearTogether) {
  AtomicFiles files;
  ASSERT_TRUE(files.add(folder_ / "a.txt", as_bytes("first")));
  ASSERT_TRUE(files.make_folder(folder_ / "maps"));
  ASSERT_TRUE(files.add(folder_ / "maps" / "b.txt", as_bytes("second")));
  EXPECT_FALSE(fs::exists(folder_ / "a.txt"));
  ASSERT_TRUE(files.commit());
  EXPECT_EQ(*read_text_file(folder_ / "a.txt"), "first");
  EXPECT_EQ(*read_text_file(folder_ / "maps" / "b.txt"), "second");
}

TEST_F(SomeFiles, LeaveNothingWhenOneHasNoRoom) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no device that is always full";
  ASSERT_TRUE(write_file_atomically(folder_ / "old.txt", as_bytes("old")));
  {
    AtomicFiles files;
    ASSERT_TRUE(files.add(folder_ / "old.txt", as_bytes("new")));
    ASSERT_TRUE(files.make_folder(folder_ / "maps"));
    ASSERT_TRUE(files.add(folder_ / "maps" / "b.txt", as_bytes("second")));
    const auto added = files.add("/dev/full", as_bytes("third"));
    ASSERT_FALSE(added);
    EXPECT_NE(added.error().message.find("No space left"), std::string::npos) << added.error().message;
  }
  EXPECT_EQ(entries(), 1);
  EXPECT_EQ(*read_text_file(folder_ / "old.txt"), "old");
}

TEST_F(SomeFiles, RemoveOutdatedOnesOnlyWhenAllOthersAreThere) {
  ASSERT_TRUE(write_file_atomically(folder_ / "old.txt", as_bytes("old")));
  {
    AtomicFiles given_up;
    given_up.remove_after(folder_ / "old.txt");
    ASSERT_TRUE(given_up.add(folder_ / "new.txt", as_bytes("new")));
  }
  EXPECT_TRUE(fs::exists(folder_ / "old.txt"));
  AtomicFiles files;
  files.remove_after(folder_ / "old.txt");
  ASSERT_TRUE(files.add(folder_ / "new.txt", as_bytes("new")));
  ASSERT_TRUE(files.commit());
  EXPECT_FALSE(fs::exists(folder_ / "old.txt"));
  EXPECT_TRUE(fs::exists(folder_ / "new.txt"));
}

TEST_F(SomeFiles, KeepAFolderThatWasThere) {
  fs::create_directory(folder_ / "maps");
  {
    AtomicFiles files;
    ASSERT_TRUE(files.make_folder(folder_ / "maps"));
  }
  EXPECT_TRUE(fs::exists(folder_ / "maps"));
}

}  // namespace
}  // namespace palpable
