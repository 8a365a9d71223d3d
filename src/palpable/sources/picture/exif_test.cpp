// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/picture/exif.hpp"

#include <span>
#include <string>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

// A TIFF block whose first directory names the EXIF directory at `at`; that one states a focal length of 28
// mm.
std::string block_with_directory_at(char at) {
  std::string out("MM\0*\0\0\0\x08\0\x01\x87\x69\0\x04\0\0\0\x01\0\0\0", 21);
  out += at;
  out += std::string("\0\0\0\0\0\x01\xA4\x05\0\x03\0\0\0\x01\0\x1C\0\0\0\0\0\0", 22);
  return out;
}

std::optional<double> focal_length_in(const std::string& file) {
  return focal_length_35mm(std::as_bytes(std::span(file)));
}

TEST(Exif, StatesTheFocalLength) {
  const auto found = focal_length_in(block_with_directory_at(26));
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, 28.0);
}

TEST(Exif, StatesNoFocalLengthWhereTheDirectoryIsMissing) {
  EXPECT_FALSE(focal_length_in(block_with_directory_at(127)));
  EXPECT_FALSE(focal_length_in(block_with_directory_at(26).substr(0, 30)));
  EXPECT_FALSE(focal_length_in("not a picture"));
  EXPECT_FALSE(focal_length_in(""));
}

}  // namespace
}  // namespace palpable::sources
