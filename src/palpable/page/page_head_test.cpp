// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/page_head.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace palpable::page {
namespace {

using session::HeadNews;

TEST(PageHead, IsToldWithTheAgeOfItsPicture) {
  const std::chrono::steady_clock::time_point now;
  const HeadNews news{HeadNews::Pictures::come, now - std::chrono::milliseconds(40),
                      session::SeenHead{{0.1, -0.2, 0.7}, 2}};
  const auto head = page_head(news, now);
  EXPECT_EQ(head.pictures, "come");
  EXPECT_NEAR(head.age_s, 0.04, 1e-9);
  ASSERT_TRUE(head.place);
  EXPECT_EQ(head.place->x_m, 0.1);
  EXPECT_EQ(head.place->z_m, 0.7);
  EXPECT_EQ(head.heads, 2);
}

TEST(PageHead, IsNoneWithoutPicturesAndBeyondTheProtocolsLimits) {
  const std::chrono::steady_clock::time_point now;
  const auto told = [&](HeadNews::Pictures pictures, std::optional<session::SeenHead> head) {
    return page_head({pictures, now, head}, now);
  };
  EXPECT_EQ(told(HeadNews::Pictures::missing, {}).pictures, "missing");
  EXPECT_EQ(told(HeadNews::Pictures::ended, {}).pictures, "ended");
  EXPECT_FALSE(told(HeadNews::Pictures::come, {}).place);
  for (const double far : {11.0, -11.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_FALSE(told(HeadNews::Pictures::come, session::SeenHead{{0.0, 0.0, far}, 1}).place) << far;
}

}  // namespace
}  // namespace palpable::page
