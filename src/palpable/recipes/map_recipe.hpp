// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/streets/map_view.hpp"
#include "palpable/models/streets/special_place_search.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/sculpt/streets/street_relief.hpp"
#include "palpable/vision/streets/street_map_from_picture.hpp"

#include <cstddef>

namespace palpable::recipes {

/// How the picture of a street map becomes a map to touch.
struct MapRecipe {
  vision::StreetMapOptions streets;
  sculpt::StreetReliefOptions relief;
  /// What on a picture is a special place.
  models::SpecialPlaceSearchOptions places;
  /// Larger pictures are reduced to this number of pixels before streets are found.
  std::size_t most_pixels = std::size_t{4} << 20U;
};

/// The streets of a map's picture as grooves between its buildings; the scene's `map` holds what was found,
/// in pixels of the given picture. Long work: reports progress, polls cancel. Any thread. Errors: as
/// vision::street_map_from_picture() and sculpt::relief_from_street_map(), without a place.
Result<MadeScene> map_from_picture(Image picture, const MapRecipe& recipe, const Work& work);

/// The same of a map that is known without a picture. Errors: as sculpt::relief_from_street_map(), without a
/// place.
Result<MadeScene> map_from_extract(StreetMap map, const MapRecipe& recipe);

/// A part of a street map's scene at a larger scale, on a plate of the same size: streets that were left out
/// for lack of room come back where there is room now. It keeps title, description and the way of a guide,
/// and materials keep what they feel like, by their names. `whole` must have a map. Errors: usage for a view
/// whose zoom is not 1 ... 100; invalid_input if no street lies in it; as sculpt::relief_from_street_map().
Result<MadeScene> part_of_map(const models::Scene& whole, const models::MapView& view,
                              const MapRecipe& recipe);

}  // namespace palpable::recipes
