// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/grid_recipe.hpp"

#include "palpable/recipes/volume_under_relief.hpp"

#include <memory>
#include <utility>

namespace palpable::recipes {

Result<MadeScene> grid_from_relief(MadeScene made, const GridRecipe& recipe, const Work& work) {
  const auto relief = relief_to_fill(made.scene);
  if (!relief) return relief.error();
  work.report(0.95, "filling the grid");
  const auto filled = sculpt::occupancy_from_relief(**relief, recipe.occupancy);
  if (!filled) return filled.error();
  auto occupancy = models::OccupancyGrid::from(*filled, work);
  if (!occupancy) return occupancy.error();
  made.scene.model = std::make_shared<const models::Grid>(models::Grid{*std::move(occupancy), *relief});
  made.scene.source.method += ", filled into a grid";
  return made;
}

}  // namespace palpable::recipes
