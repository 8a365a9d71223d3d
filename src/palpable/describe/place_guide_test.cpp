// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/place_guide.hpp"

#include "palpable/describe/found_places.hpp"
#include "palpable/describe/place_words.hpp"
#include "palpable/describe/scene_words.hpp"
#include "palpable/describe/test_maps.hpp"
#include "palpable/describe/test_scenes.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::describe {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using Extent = models::PlaceName::Extent;

std::vector<std::string> names_of(const PlaceGuide& guide) {
  std::vector<std::string> names;
  for (const NamedPlace& place : guide.places()) names.push_back(place.name.name);
  return names;
}

TEST(PlaceGuide, OffersTheRegionsOfAReliefAndItsHillsWithoutAName) {
  EXPECT_THAT(names_of(PlaceGuide(named_hills())), ElementsAre("table", "tall hill", "low hill"));
  EXPECT_THAT(names_of(PlaceGuide(two_hills())), ElementsAre("object 1", "object 2"));
}

TEST(PlaceGuide, OffersTheLinesOfADrawing) {
  const PlaceGuide guide(circle_and_line());
  ASSERT_THAT(names_of(guide), ElementsAre("line 1", "line 2"));
  EXPECT_THAT(guide.places()[0].words, HasSubstr("line 1, closed, 1"));
  // The middle of the circle belongs to what it encloses; from the line it is 40 mm up to the circle.
  EXPECT_EQ(guide.seen(0, {-0.02, 0.02}).distance_m, 0.0);
  EXPECT_THAT(position_words(circle_and_line(), 1.0, {0.0, -0.02}, guide),
              HasSubstr("On the line, from left to right. Line 2."));
  EXPECT_NEAR(guide.seen(1, {0.0, 0.01}).distance_m, 0.03, 0.001);
}

TEST(PlaceGuide, OffersTheStreetsAndPlacesOfAMap) {
  EXPECT_THAT(names_of(PlaceGuide(map_scene(town_map()))),
              IsSupersetOf({"High Street", "Mill Lane", "Church Road", "Town Hall"}));
}

TEST(PlaceGuide, AWrittenNameTakesThePlaceOfWhatItWasGivenTo) {
  models::Scene scene = named_hills();
  const PlaceGuide before(scene);
  models::PlaceName name = before.places()[1].name;
  name.name = "Mont Blanc";
  scene.names = {name, {"hut", "Closed in winter", {-0.03, 0.02}, Extent::point, {}}};
  EXPECT_FALSE(before.is_of(scene));
  EXPECT_THAT(names_of(PlaceGuide(scene)), ElementsAre("Mont Blanc", "hut", "table", "low hill"));
  // A point is more exact than the region around it.
  EXPECT_EQ(name_at(scene, {-0.03, 0.02}), "hut");
  EXPECT_EQ(name_at(scene, {-0.037, 0.02}), "Mont Blanc");
  EXPECT_EQ(name_at(scene, {0.0, 0.0}), "table");
  // Finding either ends there, so the place's words have both.
  EXPECT_THAT(position_words(scene, 1.0, {-0.03, 0.02}, PlaceGuide(scene)),
              HasSubstr("level. Hut. Closed in winter. Mont Blanc."));
}

TEST(PlaceGuide, APlaceIsReachedWhereWordsTellNoWayToIt) {
  models::Scene scene = two_hills();
  scene.names = {
      {"yard", "", {0.0, 0.0}, Extent::area, {{0.0, 0.0}, {-0.01, 0.0}, {-0.01, -0.01}, {0.0, -0.01}}}};
  const PlaceGuide guide(scene);
  for (const Place from : {Place{0.00049, 0.00049}, Place{0.00049, -0.005}}) {
    EXPECT_EQ(offset_words(-from.x_m, std::min(0.0, -from.y_m)), "here");
    EXPECT_EQ(guide.seen(0, from).distance_m, 0.0);
  }
  EXPECT_GT(guide.seen(0, {0.0008, 0.0}).distance_m, 0.0);
}

TEST(PlaceGuide, ListsTheNearestFirstWithDirectionAndDistance) {
  const PlaceGuide guide(named_hills());
  EXPECT_EQ(around_words(guide, {0.0, 0.0}, 8),
            "Here: table. Around: low hill, 14 millimetres right, 9.5 millimetres down; tall hill, 20 "
            "millimetres left, 13 millimetres up.");
}

TEST(PlaceGuide, FindsANameByItsBeginningOrAlmost) {
  const PlaceGuide guide(named_hills());
  EXPECT_EQ(*guide.find("Tall", {}), 1U);
  EXPECT_EQ(*guide.find("low hil", {}), 2U);
  EXPECT_EQ(*guide.find("lov hill", {}), 2U);
  EXPECT_THAT(guide.find("hull", {}).error().message, HasSubstr("nothing here is called 'hull'"));
}

TEST(PlaceGuide, OfEqualNamesTheNearestIsFound) {
  models::Scene scene = two_hills();
  scene.names = {{"tree", {}, {-0.03, 0.0}, Extent::point, {}}, {"tree", {}, {0.03, 0.0}, Extent::point, {}}};
  const PlaceGuide guide(scene);
  EXPECT_EQ(*guide.find("tree", {0.01, 0.0}), 1U);
  EXPECT_EQ(*guide.find("tree", {-0.01, 0.0}), 0U);
  EXPECT_EQ(*guide.find("tree", {-0.03, 0.0}), 1U) << "who stands at one looks for the other";
}

TEST(PlaceGuide, NamesAreToldByD) {
  models::Scene scene = two_hills();
  scene.names = {{"far tree", {}, {-0.04, 0.0}, Extent::point, {}},
                 {"tree", {}, {0.02, 0.0}, Extent::point, {}}};
  EXPECT_EQ(scene_parts(scene, 1.0, {})[1],
            "2 names, the nearest first: tree, 20 millimetres right; far tree, 40 millimetres left.");
}

TEST(FoundPlaces, ASolidInAirIsBegunAtItsSurfaceWhichIsToldFromBesideIt) {
  // 100 x 75 mm whose solid is a block of 20 mm at the right.
  models::Scene relief = surface_scene([](double x, double) { return x > 0.02 && x < 0.04 ? 0.02 : 0.0; });
  const auto& surface = std::get<std::shared_ptr<const models::Relief>>(relief.model);
  models::Scene scene;
  models::Lattice lattice;
  lattice.counts = {11, 11, 11};
  lattice.origin_m = {-0.05, -0.05, -0.001};
  lattice.spacing_m = 0.01;
  auto dense =
      models::DenseField::from(lattice, models::DenseContent::distance, std::vector<float>(1331, 1.0F), {});
  ASSERT_TRUE(dense) << dense.error().message;
  models::FieldOnLattice field{*std::move(dense), {-0.05, -0.0375, 0.0}, {0.05, 0.0375, 0.02}, surface, {}};
  scene.model = std::make_shared<const models::FieldOnLattice>(std::move(field));
  const Place start = start_place(scene);
  EXPECT_GT(start.x_m, 0.02);
  EXPECT_LT(start.x_m, 0.024);
  EXPECT_THAT(step_words(scene, 1.0, {}), HasSubstr("nothing here, the surface is 2"));
  EXPECT_THAT(step_words(scene, 1.0, {}), HasSubstr("millimetres right"));
  EXPECT_THAT(press_words(scene, {}, 0.004), HasSubstr("nothing to press: nothing here, the surface is"));
}

}  // namespace
}  // namespace palpable::describe
