// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/roles.hpp"

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include <gtest/gtest.h>

namespace palpable::page {
namespace {

const Guest kLooker{1, "Phone 1", Role::look, {}};
const Guest kToucher{2, "Phone 2", Role::touch, 7};

// The kinds of messages with this ruling, each with the values of its default.
template <std::size_t... kIndex>
std::set<std::string> kinds(const Guest& guest, Ruling wanted, std::index_sequence<kIndex...>) {
  std::set<std::string> found;
  const auto check = [&](const auto& message) {
    if (ruling(guest, message) == wanted) found.insert(std::string(message.kType));
  };
  (check(std::variant_alternative_t<kIndex, protocol::FromPage>()), ...);
  return found;
}
using All = std::make_index_sequence<std::variant_size_v<protocol::FromPage>>;

TEST(Roles, WhoLooksMayOnlyAsk) {
  EXPECT_EQ(kinds(kLooker, Ruling::pass, All()), (std::set<std::string>{"language", "visible"}));
  EXPECT_EQ(kinds(kLooker, Ruling::question, All()), (std::set<std::string>{"ask", "look_around"}));
  EXPECT_EQ(kinds(kLooker, Ruling::refuse, All()).size(), std::variant_size_v<protocol::FromPage> - 4);
}

TEST(Roles, WhoTouchesMayInAdditionMoveItsOwnProbe) {
  // The messages are about probe 0, which is another one's.
  EXPECT_EQ(kinds(kToucher, Ruling::refuse, All()), kinds(kLooker, Ruling::refuse, All()));
  EXPECT_EQ(ruling(kToucher, protocol::Pointer{7, 0.0, 0.0, 0.0}), Ruling::pass);
  EXPECT_EQ(ruling(kToucher, protocol::Pointer{6, 0.0, 0.0, 0.0}), Ruling::refuse);
  EXPECT_EQ(ruling(kToucher, protocol::Lift{7}), Ruling::pass);
  EXPECT_EQ(ruling(kToucher, protocol::Lift{1}), Ruling::refuse);
  EXPECT_EQ(ruling(kToucher, protocol::Find{7, 0, {}, 0.0, 0.0}), Ruling::question);
}

TEST(Roles, AnyGuestMayStopARobotAndDoNothingElseToIt) {
  for (const Guest& guest : {kLooker, kToucher}) {
    EXPECT_EQ(ruling(guest, protocol::RobotOrder{"stop"}), Ruling::pass);
    for (const char* word : {"start", "drive", "look", "touch", "near", "wide", "", "Stop", "stop "})
      EXPECT_EQ(ruling(guest, protocol::RobotOrder{word}), Ruling::refuse) << word;
  }
}

TEST(Roles, AGuestsQuestionsDoNotCountForOtherProbes) {
  const protocol::Ask position{1, "position", 0, 0.0, 0.0, 0.0, 0};
  EXPECT_EQ(asked_by(kToucher, position, 9).probe, 7);
  EXPECT_EQ(asked_by(kLooker, position, 9).probe, 9);
  EXPECT_EQ(asked_by(kLooker, protocol::Ask{1, "probe", 3, 0.0, 0.0, 0.0, 0}, 9).probe, 3);
}

TEST(Roles, AGuestReceivesTheNoticesThatConcernIt) {
  for (const char* level : {"info", "answer", "warning"}) {
    EXPECT_FALSE(concerns(kLooker, {level, "The scene is saved as /home/someone/scene.palp", {}}, false));
    EXPECT_FALSE(concerns(kToucher, {level, "The scene is saved as /home/someone/scene.palp", {}}, false));
  }
  EXPECT_TRUE(concerns(kLooker, {"fault", "The device does not answer", {}}, false));
  EXPECT_TRUE(concerns(kToucher, {"motion", "Church.", 7}, true));
  EXPECT_TRUE(concerns(kToucher, {"answer", "The names have changed: list them anew.", 7}, true));
  EXPECT_FALSE(concerns(kLooker, {"answer", "The names have changed: list them anew.", 7}, true));
  EXPECT_FALSE(concerns(kToucher, {"motion", "Church.", 0}, false));
  EXPECT_TRUE(concerns(kLooker, {"motion", "Church.", 0}, false));
  EXPECT_FALSE(concerns(kLooker, {"motion", "Church.", 7}, true));
}

}  // namespace
}  // namespace palpable::page
