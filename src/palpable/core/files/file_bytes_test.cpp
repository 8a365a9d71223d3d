// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/file_bytes.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <cerrno>
#include <fstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace palpable {
namespace {

namespace fs = std::filesystem;

bool always(std::span<const std::byte>) { return true; }
bool never(std::span<const std::byte>) { return false; }

fs::path file_with(const std::string& text) {
  fs::path path = fs::path(testing::TempDir()) / "palpable-file-bytes";
  fs::remove(path);
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// Of more than one step of reading, and no multiple of one.
std::string long_text() {
  std::string text;
  while (text.size() < 700'001) text += std::to_string(text.size());
  return text;
}

TEST(FileBytes, AreTheSameInAMemoryFile) {
  for (const std::string& text : {std::string(), std::string("short"), std::string(4096, 'x'), long_text()}) {
    const auto path = file_with(text);
    for (const auto& for_a_child : {always, never}) {
      const auto bytes = read_file_bytes(path, for_a_child);
      ASSERT_TRUE(bytes) << bytes.error().sentence();
      EXPECT_EQ(as_text(bytes->view()), text);
      EXPECT_EQ(bytes->view().descriptor() >= 0, for_a_child == always);
    }
  }
}

TEST(FileBytes, AreChosenByTheFirstBytes) {
  const auto starts_with_x = [](std::span<const std::byte> start) { return as_text(start).starts_with("x"); };
  EXPECT_GE(read_file_bytes(file_with("xyz"), starts_with_x)->view().descriptor(), 0);
  EXPECT_LT(read_file_bytes(file_with("abc"), starts_with_x)->view().descriptor(), 0);
}

TEST(FileBytes, InAMemoryFileCannotBeChanged) {
  auto bytes = read_file_bytes(file_with("whole"), always);
  ASSERT_TRUE(bytes);
  const int file = bytes->view().descriptor();
  EXPECT_EQ(::pwrite(file, "x", 1, 0), -1);
  EXPECT_EQ(errno, EPERM);
  EXPECT_EQ(::ftruncate(file, 1), -1);
  EXPECT_EQ(::mmap(nullptr, 5, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0), MAP_FAILED);
  EXPECT_EQ(as_text(bytes->view()), "whole");
}

TEST(FileBytes, KeepTheirPlaceWhenMoved) {
  auto first = read_file_bytes(file_with("moved"), always);
  ASSERT_TRUE(first);
  FileBytes second = *std::move(first);
  EXPECT_EQ(as_text(second.view()), "moved");
  const FileBytes third = std::move(second);
  EXPECT_EQ(as_text(third.view()), "moved");
}

TEST(FileBytes, LargerThanAllowedAreRefusedEitherWay) {
  for (const auto& for_a_child : {always, never}) {
    EXPECT_TRUE(read_file_bytes(file_with("12345"), for_a_child, 5));
    const auto refused = read_file_bytes(file_with("123456"), for_a_child, 5);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::invalid_input);
  }
}

TEST(FileBytes, OfAPipeAreReadOnce) {
  const fs::path path = fs::path(testing::TempDir()) / "palpable-file-bytes-pipe";
  fs::remove(path);
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const std::string text = long_text();
  std::thread writer([&] { std::ofstream(path, std::ios::binary) << text; });
  const auto bytes = read_file_bytes(path, always);
  writer.join();
  fs::remove(path);
  ASSERT_TRUE(bytes) << bytes.error().sentence();
  EXPECT_EQ(as_text(bytes->view()), text);
}

TEST(FileBytes, OfAMissingFileAreAnError) {
  const auto missing = read_file_bytes("/nowhere/at/all", always);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::invalid_input);
  EXPECT_EQ(missing.error().place, "/nowhere/at/all");
}

}  // namespace
}  // namespace palpable
