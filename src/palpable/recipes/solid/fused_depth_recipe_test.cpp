// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/fused_depth_recipe.hpp"

#include "palpable/recipes/video/seen_house.hpp"

#include <memory>
#include <string>
#include <variant>

#include <gmock/gmock.h>

namespace palpable::recipes {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Made {
  std::string notes;
  double cell_m = 0.0;
};

// The field of a house that two noisy depth maps show.
Made house_with(int most_triangles) {
  const auto maps = maps_of_house(2, 0.002);
  std::vector<sculpt::DepthView> views;
  for (const auto& one : maps)
    views.push_back({&one.map.depth, {one.map.pose.rotation, one.map.pose.translation_m, 1.0}});
  FusedDepthRecipe recipe;
  recipe.field.field.resolution = 80;
  // It is made in a fraction of the time of an adaptive field.
  recipe.field.storage = FieldStorage::dense;
  recipe.most_triangles = most_triangles;
  const auto made = field_from_views(views, recipe, "video", {});
  EXPECT_TRUE(made) << made.error().sentence();
  Made out;
  for (const Note& note : made->notes) out.notes += note.sentence + "\n";
  out.cell_m = std::get<std::shared_ptr<const models::FieldOnLattice>>(made->scene.model)->distance.cell_m();
  return out;
}

TEST(FieldFromViews, HasLargerVoxelsAndCellsWhereTheSurfaceHasTooManyTriangles) {
  const Made fine = house_with(0), coarse = house_with(12000);
  EXPECT_THAT(fine.notes, Not(HasSubstr("is rough")));
  EXPECT_THAT(coarse.notes, HasSubstr("which are larger because the measured surface is rough"));
  EXPECT_GT(coarse.cell_m, 1.1 * fine.cell_m);
}

}  // namespace
}  // namespace palpable::recipes
