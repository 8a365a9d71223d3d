// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/scene/place_name.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::models {
namespace {

using ::testing::HasSubstr;

PlaceName named(std::string name, Place at = {0.01, 0.02}) { return {std::move(name), {}, at, {}, {}}; }

std::string refusal(PlaceNames names, PlaceName name) {
  const auto edited = with_name(std::move(names), std::move(name));
  return edited ? std::string() : edited.error().message;
}

TEST(PlaceName, IsKeptAsItIsWritten) {
  for (const char* const name :
       {"Grandma's house", "<b>Tower</b> & \"moat\"", "\xd7\x91\xd7\x99\xd7\xaa", "Z\xc3\xbcrich"}) {
    const auto names = with_name({}, named(name));
    ASSERT_TRUE(names) << name;
    EXPECT_EQ(names->front().name, name);
    EXPECT_TRUE(is_valid(names->front()));
  }
}

TEST(PlaceName, LosesWhatControlsADisplayOrTheDirectionOfWriting) {
  const auto names = with_name({}, named(" a\x1b[31m\tgate\xe2\x80\xae of\n\nstone "));
  ASSERT_TRUE(names);
  EXPECT_EQ(names->front().name, "a[31m gate of stone");
}

TEST(PlaceName, IsRefusedIfItIsEmptyTooLongOrNoText) {
  EXPECT_THAT(refusal({}, named(" \n\t ")), HasSubstr("at least one letter"));
  EXPECT_THAT(refusal({}, named("\xe2\x80\xae")), HasSubstr("at least one letter"));
  EXPECT_THAT(refusal({}, named(" \u200B\uFEFF ")), HasSubstr("at least one letter"))
      << "neither seen nor spoken";
  EXPECT_THAT(refusal({}, named(std::string(10000, 'x'))),
              HasSubstr("at most 400 bytes, and this one has 10000"));
  EXPECT_THAT(refusal({}, named("a\xff")), HasSubstr("UTF-8"));
  PlaceName wordy = named("gate");
  wordy.sentence = std::string(2001, 'x');
  EXPECT_THAT(refusal({}, wordy), HasSubstr("at most 2000 bytes"));
}

TEST(PlaceName, MayBeThatOfSeveralPlacesButOnlyOnceOfOne) {
  const auto two = with_name({named("tree")}, named("tree", {0.03, 0.0}));
  ASSERT_TRUE(two);
  EXPECT_EQ(two->size(), 2U);
  EXPECT_THAT(refusal(*two, named("tree")), HasSubstr("called 'tree' already"));
  // Editing it leaves it where it is.
  EXPECT_TRUE(with_name(*two, named("tree"), 0));
}

TEST(PlaceName, AreAtMostFiveHundred) {
  PlaceNames names;
  for (std::size_t i = 0; i < kMaxPlaceNames; ++i) names.push_back(named("n" + std::to_string(i)));
  EXPECT_THAT(refusal(names, named("one more")), HasSubstr("at most 500 names"));
}

TEST(PlaceName, IsInvalidWithNumbersThatAreNone) {
  PlaceName name = named("gate");
  name.at.x_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_valid(name));
  name = named("gate");
  name.line = {{0.0, 0.0}};
  EXPECT_FALSE(is_valid(name));
}

TEST(PlaceName, NearestOnALineIsTheFootOfThePerpendicularOrAnEnd) {
  const std::vector<Place> line{{0.0, 0.0}, {0.01, 0.0}, {0.01, 0.01}};
  EXPECT_NEAR(nearest_on_line(line, {0.004, 0.003}).distance_m, 0.003, 1e-12);
  EXPECT_NEAR(nearest_on_line(line, {0.004, 0.003}).at.x_m, 0.004, 1e-12);
  EXPECT_NEAR(nearest_on_line(line, {-0.003, -0.004}).distance_m, 0.005, 1e-12);
}

TEST(PlaceName, AnAreaIsWhatItsLineEncloses) {
  const std::vector<Place> square{{0.0, 0.0}, {0.01, 0.0}, {0.01, 0.01}, {0.0, 0.01}};
  EXPECT_EQ(nearest_in_area(square, {0.004, 0.003}).distance_m, 0.0);
  // Beside the side that closes it.
  EXPECT_NEAR(nearest_in_area(square, {-0.002, 0.005}).distance_m, 0.002, 1e-12);
  EXPECT_NEAR(area_m2(square), 1e-4, 1e-12);
}

}  // namespace
}  // namespace palpable::models
