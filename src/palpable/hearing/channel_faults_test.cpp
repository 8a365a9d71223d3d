// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/hearing/channel_faults.hpp"

#include <gtest/gtest.h>

namespace palpable::hearing {
namespace {

TEST(ChannelFaults, AreSilentOrEqualChannels) {
  const std::vector<float> one{0.1F, 0.2F}, two{0.2F, 0.1F}, silent{0.0F, 0.0F};
  EXPECT_TRUE(check_channels({16'000.0, {one, two}}));
  EXPECT_TRUE(check_channels({16'000.0, {silent, silent}}));
  EXPECT_TRUE(check_channels({16'000.0, {{}, {}}}));
  const auto dead = check_channels({16'000.0, {one, silent, two}});
  ASSERT_FALSE(dead);
  EXPECT_EQ(dead.error().message, "has no sound in channel 2");
  const auto copied = check_channels({16'000.0, {one, two, one}});
  ASSERT_FALSE(copied);
  EXPECT_NE(copied.error().message.find("channels 1 and 3"), std::string::npos);
}

}  // namespace
}  // namespace palpable::hearing
