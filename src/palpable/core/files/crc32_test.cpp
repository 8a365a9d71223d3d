// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/crc32.hpp"

#include <random>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(Crc32, OfTheDigitsIsTheCheckValueOfItsStandard) {
  constexpr std::string_view kDigits = "123456789";
  EXPECT_EQ(crc32(std::as_bytes(std::span(kDigits))), 0xCBF43926U);
}

TEST(Crc32, OfNothingIsTheValueBefore) {
  EXPECT_EQ(crc32({}), 0U);
  EXPECT_EQ(crc32({}, 0xCBF43926U), 0xCBF43926U);
}

TEST(Crc32, OfPartsIsThatOfTheWhole) {
  std::mt19937 random(7);
  for (const std::size_t count : {1, 7, 256, 4099}) {
    std::vector<std::byte> bytes(count);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    const std::span all(bytes);
    EXPECT_EQ(crc32(all.subspan(count / 3), crc32(all.first(count / 3))), crc32(all)) << count;
  }
}

}  // namespace
}  // namespace palpable
