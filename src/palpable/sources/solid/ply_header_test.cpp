// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/ply_header.hpp"

#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

bool check(std::string_view text) { return parse_ply_header(std::as_bytes(std::span(text))).has_value(); }

const std::string kAscii =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::string binary(const std::string& vertices) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty double y\nelement face 1\nproperty list uchar int "
         "vertex_indices\nend_header\n";
}

TEST(PlyHeader, AcceptsAFileThatHoldsWhatItStates) {
  EXPECT_TRUE(check(kAscii + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
  EXPECT_TRUE(check(kAscii + "0 0 0\r\n\n1 0 0\n0 1 0\n3 0 1 2"));
  EXPECT_TRUE(check(binary("2") + std::string(24 + 13, 'x')));
}

TEST(PlyHeader, RefusesAFileThatWasCutOff) {
  EXPECT_FALSE(check(kAscii + "0 0 0\n1 0 0\n0 1 0\n"));
  EXPECT_FALSE(check(kAscii));
  EXPECT_FALSE(check(binary("2") + std::string(24, 'x')));
  EXPECT_FALSE(check(kAscii.substr(0, kAscii.size() - 3)));
}

TEST(PlyHeader, RefusesCountsThatNoFileHolds) {
  for (const std::string count : {"99999999999", "18446744073709551615", "1e9", "-1", ""})
    EXPECT_FALSE(check(binary(count) + std::string(100, 'x'))) << count;
}

TEST(PlyHeader, RefusesWordsAndTypesThatItDoesNotKnow) {
  const std::string good(kAscii);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_TRUE(check(with("float x", "float32 x")));
  EXPECT_FALSE(check(with("float x", "flaot x")));
  EXPECT_FALSE(check(with("ascii", "binary_middle_endian")));
  EXPECT_FALSE(check(with("element", "elemant")));
  EXPECT_FALSE(check(with("list uchar", "list float")));
}

}  // namespace
}  // namespace palpable::sources
