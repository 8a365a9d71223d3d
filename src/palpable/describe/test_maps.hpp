// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/models/scene/scene.hpp"

#include <memory>
#include <utility>

namespace palpable::describe {

/// A flat plate of 100 x 100 mm with a map.
inline models::Scene map_scene(StreetMap map) {
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(
      *models::Relief::from_samples(Raster<float>(101, 101, 0.001F), 0.1 / 101));
  scene.map = std::make_shared<const StreetMap>(std::move(map));
  scene.title = "A small town";
  return scene;
}

/// 500 x 500 m on 1000 px: High Street from west to east, Mill Lane north from its middle, Church Road across
/// at three quarters, an unnamed street, a church, a pond and two buildings.
inline StreetMap town_map() {
  StreetMap map;
  map.width_px = map.height_px = 1000;
  map.metres_per_px = 0.5;
  map.streets = {{"High Street", 12.0, {{500, 500}, {0, 500}}},
                 {"High Street", 12.0, {{500, 500}, {750, 500}}},
                 {"High Street", 12.0, {{750, 500}, {999, 500}}},
                 {"Mill Lane", 12.0, {{500, 500}, {500, 100}}},
                 {"Church Road", 12.0, {{750, 0}, {750, 500}}},
                 {"Church Road", 12.0, {{750, 500}, {750, 900}}},
                 {"", 12.0, {{500, 100}, {750, 0}}}};
  map.junctions = {{{500, 500}, 3, false}, {{750, 500}, 4, false}};
  map.areas = {{MapArea::Kind::water, {{100, 700}, {200, 700}, {200, 800}}},
               {MapArea::Kind::building, {{50, 50}, {100, 50}, {100, 100}}},
               {MapArea::Kind::building, {{250, 50}, {300, 50}, {300, 100}}}};
  map.labels = {{"Town Hall", 1.0, 0.0, {{600, 300}, {700, 300}, {700, 320}, {600, 320}}, false}};
  return map;
}

}  // namespace palpable::describe
