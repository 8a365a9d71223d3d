// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/share/guests.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::page {
namespace {

std::vector<std::string> news_of(Guests& guests) {
  std::vector<std::string> all;
  while (auto one = guests.next_news()) all.push_back(*one);
  return all;
}

TEST(Guests, EachHasANameAndWhoTouchesAProbeOfItsOwn) {
  Guests guests(8);
  guests.set_probes(1, 8);
  const std::string phone = guests.add(Role::touch, "Mozilla/5.0 (iPhone; CPU) Mobile/15E", 0.0).value();
  const std::string tablet = guests.add(Role::touch, "Mozilla/5.0 (Linux; Android 14)", 0.0).value();
  const std::string other = guests.add(Role::look, "<b>", 0.0).value();
  EXPECT_EQ(guests.with_secret(phone)->name, "Phone 1");
  EXPECT_EQ(guests.with_secret(phone)->probe, 8);
  EXPECT_EQ(guests.with_secret(tablet)->name, "Tablet 2");
  EXPECT_EQ(guests.with_secret(tablet)->probe, 7);
  EXPECT_EQ(guests.with_secret(other)->name, "Computer 3");
  EXPECT_FALSE(guests.with_secret(other)->probe);
  EXPECT_EQ(guests.with_secret(""), nullptr);
  guests.remove(1);
  EXPECT_EQ(guests.with_secret(phone), nullptr);
  EXPECT_EQ(guests.with_secret(guests.add(Role::touch, "", 0.0).value())->probe, 8);
}

TEST(Guests, APlaceIsGivenUpOnlyByOneThatIsAway) {
  Guests guests(2);
  guests.set_probes(1, 8);
  const std::string first = guests.add(Role::look, "", 0.0).value();
  const std::string second = guests.add(Role::look, "", 0.0).value();
  guests.set_presence(1, Presence::here, 0.0);
  guests.set_presence(2, Presence::asleep, 0.0);
  EXPECT_FALSE(guests.add(Role::look, "", 1000.0));
  guests.set_presence(2, Presence::away, 1000.0);
  EXPECT_FALSE(guests.add(Role::look, "", 1029.0));
  EXPECT_TRUE(guests.add(Role::look, "", 1030.0));
  EXPECT_NE(guests.with_secret(first), nullptr);
  EXPECT_EQ(guests.with_secret(second), nullptr);
}

TEST(Guests, WithoutAFreeProbeOnlyLookingIsPossible) {
  Guests guests(8);
  guests.set_probes(8, 8);
  ASSERT_TRUE(guests.add(Role::touch, "", 0.0));
  EXPECT_FALSE(guests.add(Role::touch, "", 0.0));
  EXPECT_TRUE(guests.add(Role::look, "", 0.0));
}

TEST(Guests, TellsOfArrivalsAtOnceAndOfChangesThatLast) {
  Guests guests(8);
  guests.set_probes(1, 8);
  ASSERT_TRUE(guests.add(Role::touch, "iPhone", 0.0));
  guests.set_presence(1, Presence::here, 1.0);
  EXPECT_THAT(news_of(guests), testing::ElementsAre("Phone 1 has joined, and touches with probe 9."));
  // A page that is loaded again.
  guests.set_presence(1, Presence::away, 2.0);
  guests.update(3.0);
  guests.set_presence(1, Presence::here, 3.0);
  guests.update(10.0);
  EXPECT_THAT(news_of(guests), testing::IsEmpty());
  guests.set_presence(1, Presence::asleep, 10.0);
  guests.update(12.0);
  guests.update(13.0);
  EXPECT_THAT(news_of(guests), testing::ElementsAre("Phone 1 sleeps, or shows something else."));
  guests.set_presence(1, Presence::here, 20.0);
  guests.update(22.0);
  EXPECT_THAT(news_of(guests), testing::ElementsAre("Phone 1 is back."));
}

TEST(Guests, TellsOfOneThatIsComingOnce) {
  Guests guests(8);
  guests.set_probes(1, 8);
  ASSERT_TRUE(guests.add(Role::look, "iPhone", 0.0));
  guests.update(1.0);
  EXPECT_THAT(news_of(guests), testing::IsEmpty());
  guests.update(5.0);
  guests.update(50.0);
  EXPECT_THAT(news_of(guests), testing::ElementsAre("Phone 1 is on the way."));
  guests.set_presence(1, Presence::here, 51.0);
  EXPECT_THAT(news_of(guests), testing::ElementsAre("Phone 1 has joined, and looks."));
}

TEST(Guests, OneThatOpensItsPageAllTheTimeIsSlowedDown) {
  Guests guests(8);
  ASSERT_TRUE(guests.add(Role::look, "", 0.0));
  int opened = 0;
  for (int k = 0; k < 100; ++k) opened += guests.may_open(1, 0.0) ? 1 : 0;
  EXPECT_EQ(opened, 20);
  EXPECT_TRUE(guests.may_open(1, 1.0));
  EXPECT_FALSE(guests.may_open(2, 1.0));
}

}  // namespace
}  // namespace palpable::page
