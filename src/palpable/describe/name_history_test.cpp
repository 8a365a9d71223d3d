// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/name_history.hpp"

#include "palpable/describe/test_scenes.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::describe {
namespace {

using ::testing::HasSubstr;

class EditingNames : public testing::Test {
 protected:
  std::string done(Result<NamesEdit> edit) {
    if (!edit) return edit.error().message;
    scene.names = std::move(edit->names);
    return edit->words;
  }
  std::string name(std::string words, Place at, std::optional<std::size_t> place = {}) {
    return done(history.name(scene, PlaceGuide(scene), {std::move(words), {}, at, {}, {}}, place));
  }

  models::Scene scene = named_hills();
  NameHistory history;
};

TEST_F(EditingNames, EachEditIsSaidAndCanBeUndone) {
  EXPECT_EQ(name("hut", {0.04, 0.03}), "Named: hut, upper right.");
  EXPECT_EQ(name("cabin", {}, 0), "hut is now called cabin.");
  ASSERT_EQ(scene.names.size(), 1U);
  // It has stayed where it was.
  EXPECT_EQ(scene.names[0].at, (Place{0.04, 0.03}));
  EXPECT_EQ(done(history.remove(scene, PlaceGuide(scene), 0)), "Deleted: cabin.");
  EXPECT_TRUE(scene.names.empty());
  EXPECT_EQ(done(history.undo(scene)), "Undone: deleting cabin.");
  EXPECT_EQ(done(history.undo(scene)), "Undone: naming cabin.");
  EXPECT_EQ(scene.names.at(0).name, "hut");
  EXPECT_EQ(done(history.redo(scene)), "Redone: naming cabin.");
  EXPECT_EQ(scene.names.at(0).name, "cabin");
}

TEST_F(EditingNames, WhatTheProgramFoundIsRenamedButNotDeleted) {
  EXPECT_EQ(name("Mont Blanc", {}, 1), "tall hill is now called Mont Blanc.");
  EXPECT_EQ(scene.names.at(0).extent, models::PlaceName::Extent::label);
  EXPECT_THAT(done(history.remove(scene, PlaceGuide(scene), 1)), HasSubstr("was found by the program"));
}

TEST_F(EditingNames, RefusesAPlaceThatIsNoLongerThere) {
  EXPECT_THAT(name("x", {}, 99), HasSubstr("names have changed"));
  EXPECT_THAT(done(history.remove(scene, PlaceGuide(scene), 99)), HasSubstr("names have changed"));
  EXPECT_THAT(done(history.undo(scene)), HasSubstr("no change of a name to undo"));
}

}  // namespace
}  // namespace palpable::describe
