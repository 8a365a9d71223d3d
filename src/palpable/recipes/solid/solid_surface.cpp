// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/solid_surface.hpp"

#include "palpable/core/text/figure.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/solid/superquadric_source.hpp"
#include "palpable/sculpt/triangles/box.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

constexpr double kMmPerM = 1000.0;

Note note_on(const PredictedSolid& predicted) {
  return {fmt::format(
      "{} superquadrics are {} mm from the surface (mean){}.", predicted.shapes.size(),
      figure(kMmPerM * predicted.predicted_error_m),
      predicted.surface.triangles.empty()
          ? std::string()
          : fmt::format("; their surface, corrected, {} mm", figure(kMmPerM * predicted.corrected_error_m)))};
}

}  // namespace

std::string words_of(SolidSurface surface) {
  switch (surface) {
    case SolidSurface::given:
      return "";
    case SolidSurface::superquadrics:
      return ", by superquadrics";
    case SolidSurface::corrected:
      return ", by superquadrics, corrected";
  }
  return "";
}

Result<Solid> with_surface(Solid solid, FieldRecipe recipe, const Work& work) {
  if (recipe.surface == SolidSurface::given || !solid.primitives.empty()) return solid;
  if (recipe.surface == SolidSurface::superquadrics) recipe.prediction.passes = 0;
  auto predicted = predicted_solid(*solid.distance, recipe.prediction, work);
  if (!predicted) return predicted.error();
  solid.notes.push_back(note_on(*predicted));
  if (predicted->surface.triangles.empty()) {
    auto distance = sculpt::distance_of(predicted->shapes);
    if (!distance) return distance.error();
    solid.distance = std::move(*distance);
  } else {
    const auto cell_m = sculpt::finest_cell_m(sculpt::bounds_of(predicted->surface), recipe.field);
    if (!cell_m) return cell_m.error();
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

}  // namespace palpable::recipes
