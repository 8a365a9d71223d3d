// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/share/invitations.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::page {
namespace {

using testing::HasSubstr;

TEST(Invitations, ALinkIsUsedOnce) {
  Invitations all(600.0);
  const std::string token = all.open(Role::touch, 0.0).value();
  EXPECT_TRUE(all.offers(token, 599.0));
  EXPECT_EQ(all.use(token, 599.0).value(), Role::touch);
  EXPECT_FALSE(all.is_open());
  const auto again = all.use(token, 599.0);
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().message, HasSubstr("used already"));
}

TEST(Invitations, ALinkExpires) {
  Invitations all(600.0);
  const std::string token = all.open(Role::look, 0.0).value();
  EXPECT_FALSE(all.expire(599.0));
  EXPECT_FALSE(all.offers(token, 600.0));
  // Also where nobody has called expire() yet.
  const auto late = all.use(token, 600.0);
  ASSERT_FALSE(late);
  EXPECT_THAT(late.error().message, HasSubstr("expired"));
  EXPECT_FALSE(all.expire(601.0)) << "once";
}

TEST(Invitations, ANewLinkReplacesTheOpenOne) {
  Invitations all(600.0);
  const std::string first = all.open(Role::touch, 0.0).value();
  const std::string second = all.open(Role::look, 1.0).value();
  EXPECT_NE(first, second);
  const auto refused = all.use(first, 2.0);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("withdrawn"));
  EXPECT_EQ(all.use(second, 2.0).value(), Role::look);
}

TEST(Invitations, WhatIsNoLinkIsRefused) {
  Invitations all(600.0);
  for (const char* token : {"", "0123456789abcdef0123456789abcdef"}) EXPECT_FALSE(all.use(token, 0.0));
  // The oldest fates are forgotten, the links remain refused.
  const std::string old = all.open(Role::look, 0.0).value();
  for (int k = 0; k < 100; ++k) ASSERT_TRUE(all.open(Role::look, 0.0));
  EXPECT_FALSE(all.use(old, 0.0));
}

}  // namespace
}  // namespace palpable::page
