// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/field_scene.hpp"

#include "palpable/core/text/figure.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/solid/superquadric_source.hpp"
#include "palpable/sculpt/triangles/box.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

constexpr double kMmPerM = 1000.0;

Note note_on(const PredictedSolid& predicted) {
  return {fmt::format(
      "{} {} mm from the surface (mean){}.",
      predicted.shapes.size() == 1 ? "One superquadric is"
                                   : fmt::format("{} superquadrics are", predicted.shapes.size()),
      figure(kMmPerM * predicted.predicted_error_m),
      predicted.surface.triangles.empty()
          ? std::string()
          : fmt::format("; corrected by it, {} mm", figure(kMmPerM * predicted.corrected_error_m)))};
}

}  // namespace

Result<Solid> with_surface(Solid solid, FieldRecipe recipe, const Work& work) {
  if (recipe.surface == SolidSurface::given || !solid.primitives.empty()) return solid;
  if (recipe.surface == SolidSurface::superquadrics) recipe.prediction.passes = 0;
  auto predicted = predicted_solid(*solid.distance, recipe.prediction, work);
  if (!predicted) return predicted.error();
  solid.notes.push_back(note_on(*predicted));
  solid.surface = ", by superquadrics";
  if (predicted->surface.triangles.empty()) {
    auto distance = sculpt::distance_of(predicted->shapes);
    if (!distance) return distance.error();
    solid.distance = std::move(*distance);
  } else {
    const auto cell_m = sculpt::finest_cell_m(sculpt::bounds_of(predicted->surface), recipe.field);
    if (!cell_m) return cell_m.error();
    solid.surface += ", corrected";
    // It may fold and cross itself, by less than a sample: pieces smaller than that are not cut, of which
    // there would be millions. What is repaired there is nothing of the input's.
    Solid corrected;
    corrected.pose = solid.pose;
    recipe.walls = sculpt::kWallsAsTheyAre;
    const double finest_m = std::max(*cell_m, predicted->spacing_m);
    if (auto done = enclose(corrected, predicted->surface, finest_m, recipe, work); !done)
      return std::move(done).error();
    solid.distance = std::move(corrected.distance);
  }
  solid.primitives = std::move(predicted->shapes);
  return solid;
}

Result<MadeScene> field_scene(Solid given, const std::string& input, const FieldRecipe& recipe,
                              const Work& work) {
  auto solid = with_surface(std::move(given), recipe, work);
  if (!solid) return solid.error();
  auto field = stored_field(*solid, recipe, work);
  if (!field) return field.error();
  models::Scene scene;
  scene.scene_from_input = solid->scene_from_input;
  scene.pose = solid->pose;
  scene.source.method = fmt::format("field of {}{}, {}", input, solid->surface, field->method);
  scene.model = std::move(field->model);
  std::vector<Note> notes = std::move(solid->notes);
  notes.insert(notes.end(), field->notes.begin(), field->notes.end());
  return MadeScene{std::move(scene), std::move(notes)};
}

}  // namespace palpable::recipes
