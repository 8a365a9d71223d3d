// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/system/memory.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

namespace palpable {
namespace {

class AvailableMemory : public testing::Test {
 protected:
  AvailableMemory()
      : folder_(testing::TempDir() + "palpable_" +
                testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::remove_all(folder_);
    files_ = {folder_ / "self", folder_ / "meminfo", folder_ / "groups"};
  }
  ~AvailableMemory() override { std::filesystem::remove_all(folder_); }
  static void write(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }

  std::filesystem::path folder_;
  MemoryFiles files_;
};

TEST_F(AvailableMemory, IsWhatTheSystemHasAvailable) {
  write(files_.system, "MemTotal:  9000 kB\nMemFree:  10 kB\nMemAvailable:   2000 kB\n");
  EXPECT_EQ(available_memory_bytes(files_), 2000U * 1024U);
}

TEST_F(AvailableMemory, IsLimitedByTheControlGroupAndItsParents) {
  write(files_.system, "MemAvailable:   2000 kB\n");
  write(files_.process / "cgroup", "0::/outer/inner\n");
  write(files_.control_groups / "outer/inner/memory.max", "max\n");
  write(files_.control_groups / "outer/inner/memory.current", "100000\n");
  EXPECT_EQ(available_memory_bytes(files_), 2000U * 1024U);
  write(files_.control_groups / "outer/memory.max", "900000\n");
  write(files_.control_groups / "outer/memory.current", "500000\n");
  EXPECT_EQ(available_memory_bytes(files_), 400000U);
  write(files_.control_groups / "outer/memory.stat", "anon 5\ninactive_file 50000\n");
  EXPECT_EQ(available_memory_bytes(files_), 450000U);
  write(files_.control_groups / "outer/inner/memory.max", "90000\n");
  EXPECT_EQ(available_memory_bytes(files_), 0U);
}

TEST_F(AvailableMemory, IsUnknownIfNothingIsReported) {
  write(files_.system, "MemAvailable: much\n");
  EXPECT_EQ(available_memory_bytes(files_), std::nullopt);
}

TEST_F(AvailableMemory, IsReportedByThisSystem) {
  const auto bytes = available_memory_bytes();
  if (!bytes) GTEST_SKIP() << "this system does not tell its memory";
  EXPECT_GT(*bytes, std::size_t{1} << 20U);
}

}  // namespace
}  // namespace palpable
