// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/placement_notes.hpp"

#include <string>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

/// The first note on a cube with this side, which is scaled to 50 mm.
std::string note_on_cube(double side) {
  const sculpt::Box box{{}, {side, side, side}};
  sculpt::PlacementOptions options;
  options.default_size = sculpt::DefaultSize::for_a_hand;
  const auto placement = sculpt::placement_of(box, options, 0.0);
  EXPECT_TRUE(placement);
  const auto notes = placement_notes(*placement, box, options);
  return notes.empty() ? "" : notes.front().sentence;
}

TEST(PlacementNotes, SayTheSizeOfAnyUnit) {
  EXPECT_EQ(note_on_cube(20.0),
            "The input states no unit: it was scaled to fit a hand, one unit being 2.5 mm.");
  EXPECT_EQ(note_on_cube(2e-6),
            "The input states no unit: it was scaled to fit a hand, one unit being 25000000 mm.");
  EXPECT_EQ(note_on_cube(1e6),
            "The input states no unit: it was scaled to fit a hand, 20000 units being one mm.");
  EXPECT_EQ(note_on_cube(1e13),
            "The input states no unit: it was scaled to fit a hand, 200000000000 units being one mm.");
}

TEST(PlacementNotes, SayThatAMeshIsRoundedFarFromItsOrigin) {
  const auto notes_at = [](double x) {
    return rounding_notes({{x, 0, 0}, {x + 10, 10, 10}}, 1.2e-7 * (x + 10));
  };
  EXPECT_TRUE(notes_at(0.0).empty());
  EXPECT_TRUE(notes_at(1e4).empty());
  // A house in projected map coordinates: steps of half a metre.
  ASSERT_EQ(notes_at(5.4e6).size(), 1U);
  EXPECT_NE(notes_at(5.4e6).front().sentence.find("3.7 %"), std::string::npos);
}

}  // namespace
}  // namespace palpable::recipes
