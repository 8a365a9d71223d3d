// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/two_diy/two_diy_wire.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

std::vector<std::byte> answer(std::uint8_t id, float first, float second) {
  std::vector<std::byte> bytes(9);
  bytes[0] = std::byte{id};
  std::memcpy(bytes.data() + 1, &first, 4);
  std::memcpy(bytes.data() + 5, &second, 4);
  return bytes;
}

TEST(TwoDiyWire, SetsUpTheThirdVersionByTheseBytes) {
  const auto message = setup_message(kTwoDiyVariants[0]);
  // Little-endian: 82.77 = 42A58A3D, 5219.3 = 45A31A66, 97.23 = 42C275C3, 5299.7 = 45A59D9A.
  constexpr std::array<std::uint8_t, 26> kBytes{1,    1,    3,    1,    1,    3,    1,    1,    0,
                                                0,    0x3D, 0x8A, 0xA5, 0x42, 0x66, 0x1A, 0xA3, 0x45,
                                                0xC3, 0x75, 0xC2, 0x42, 0x9A, 0x9D, 0xA5, 0x45};
  for (std::size_t k = 0; k < kBytes.size(); ++k)
    EXPECT_EQ(std::to_integer<int>(message[k]), int{kBytes[k]}) << k;
}

TEST(TwoDiyWire, SendsTheDirectionsOfTheFirstVersionByPort) {
  const auto message = setup_message(kTwoDiyVariants[1]);
  // Port 1 clockwise, port 2 counter-clockwise.
  EXPECT_EQ(std::to_integer<int>(message[3]), 0);
  EXPECT_EQ(std::to_integer<int>(message[4]), 1);
}

TEST(TwoDiyAnswers, AreFoundInPiecesAndAmongOtherBytes) {
  TwoDiyAnswers answers;
  const auto whole = answer(kTwoDiyId, 12.5F, -80.0F);
  for (std::size_t cut = 0; cut <= whole.size(); ++cut) {
    const std::span<const std::byte> bytes(whole);
    const auto early = answers.take(bytes.first(cut));
    const auto late = answers.take(bytes.subspan(cut));
    const auto found = cut == whole.size() ? early : late;
    ASSERT_TRUE(found) << cut;
    EXPECT_EQ((*found)[0], 12.5F);
    EXPECT_EQ((*found)[1], -80.0F);
  }
  std::vector<std::byte> bytes{std::byte{9}, std::byte{77}};
  bytes.insert(bytes.end(), whole.begin(), whole.end());
  const auto second = answer(kTwoDiyId, 1.0F, 2.0F);
  bytes.insert(bytes.end(), second.begin(), second.end());
  EXPECT_EQ((*answers.take(bytes))[1], 2.0F);
  EXPECT_EQ(answers.dropped(), 2U);
  EXPECT_EQ(answers.complete(), whole.size() + 3U);
}

TEST(TwoDiyAnswers, WithImpossibleAnglesAreDropped) {
  TwoDiyAnswers answers;
  for (const float bad : {std::nanf(""), INFINITY, 1e9F})
    EXPECT_FALSE(answers.take(answer(kTwoDiyId, bad, 0.0F)));
  std::mt19937 random(3);
  for (int k = 0; k < 100000; ++k) {
    const std::byte byte{static_cast<std::uint8_t>(random())};
    const auto found = answers.take({&byte, 1});
    const auto angles = found.value_or(std::array{0.0F, 0.0F});
    EXPECT_LE(std::max(std::abs(angles[0]), std::abs(angles[1])), 3600.0F);
  }
  // Whatever came before, at most two complete answers later it is in step.
  for (int k = 0; k < 3; ++k) answers.take(answer(kTwoDiyId, 10.0F, 20.0F));
  const auto found = answers.take(answer(kTwoDiyId, 10.0F, 20.0F));
  ASSERT_TRUE(found);
  EXPECT_EQ((*found)[0], 10.0F);
}

}  // namespace
}  // namespace palpable::device
