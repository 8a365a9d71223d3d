// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/geometry/map_place.hpp"

#include <gtest/gtest.h>

namespace palpable {
namespace {

using Kind = MapPlace::Kind;

TEST(MapPlace, NamesTellTheirKindInFiveLanguages) {
  EXPECT_EQ(map_place_kind_in("St Mary's Church"), Kind::church);
  EXPECT_EQ(map_place_kind_in("ÉGLISE SAINT-CHARLES"), Kind::church);
  EXPECT_EQ(map_place_kind_in("Marienkirche"), Kind::church);
  EXPECT_EQ(map_place_kind_in("Gare de Monaco"), Kind::station);
  EXPECT_EQ(map_place_kind_in("Hauptbahnhof"), Kind::station);
  EXPECT_EQ(map_place_kind_in("Leeds General Infirmary"), Kind::hospital);
  EXPECT_EQ(map_place_kind_in("Hospital Chapel"), Kind::church);
  EXPECT_EQ(map_place_kind_in("Hôtel de Ville"), Kind::town_hall);
  EXPECT_EQ(map_place_kind_in("Town Hall"), Kind::town_hall);
  EXPECT_EQ(map_place_kind_in("Hyde Park"), std::nullopt);
  EXPECT_EQ(map_place_kind_in(""), std::nullopt);
}

TEST(MapPlace, NamesOfStreetsTellNone) {
  for (const char* const name :
       {"Church Road", "Station Street", "Bahnhofstrasse", "Rue de la Gare", "Kirchweg"})
    EXPECT_EQ(map_place_kind_in(name), std::nullopt) << name;
}

TEST(MapPlace, StreetsAreToldByTheirFirstOrLastWord) {
  for (const char* const name :
       {"Mill Lane", "Rue Plati", "landstrasse", "Tunnel Dorsale", "Hintergass", "Rampe Major"})
    EXPECT_TRUE(is_street_name(name)) << name;
  for (const char* const name : {"Monaco", "The Street Cafe", ""}) EXPECT_FALSE(is_street_name(name)) << name;
}

TEST(MapPlace, IsSaidWithItsKindOnce) {
  EXPECT_EQ(words_of(MapPlace{Kind::bus_stop, "Mill Lane"}), "Mill Lane, bus stop");
  EXPECT_EQ(words_of(MapPlace{Kind::church, "St Mary's Church"}), "St Mary's Church");
  EXPECT_EQ(words_of(MapPlace{Kind::hospital, ""}), "hospital");
  MapPlace crossing{Kind::crossing, ""};
  crossing.tactile_paving = true;
  EXPECT_EQ(words_of(crossing), "crossing with tactile paving");
}

TEST(MapPlace, EveryKindHasANameInFiles) {
  for (int k = 0; k <= static_cast<int>(Kind::entrance); ++k)
    EXPECT_EQ(map_place_kind_from(name_of(static_cast<Kind>(k))), static_cast<Kind>(k));
  EXPECT_EQ(map_place_kind_from("castle"), std::nullopt);
}

}  // namespace
}  // namespace palpable
