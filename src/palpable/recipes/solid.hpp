// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/note.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/recipes/field_recipe.hpp"
#include "palpable/sculpt/field/dense_field_from_source.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <memory>
#include <string>
#include <vector>

namespace palpable::recipes {

using SceneFromInput = Transform<SceneFrame, models::InputFrame>;

/// What a field is sampled from, as it stands in the scene.
struct Solid {
  std::unique_ptr<sculpt::DistanceSource> distance;
  std::vector<Note> notes;
  SceneFromInput scene_from_input;
  /// How exactly the input itself describes its surface, metres; 0 = as exactly as is asked for.
  double exact_to_m = 0.0;
  /// As they stand in the scene, where it consists of some.
  std::vector<models::Superquadric> primitives;
};

/// A mesh, repaired as it needs.
Result<Solid> solid_of(Mesh mesh, const FieldRecipe& recipe, const Work& work);
Result<Solid> solid_of(std::vector<models::Superquadric> shapes, const FieldRecipe& recipe);
/// From a contour of voxels, which describes its surface to `exact_to_m` of the input.
Result<Solid> solid_of_contour(Mesh surface, double exact_to_m, const FieldRecipe& recipe);

/// The lattice of a dense field.
sculpt::DenseFieldOptions dense_options(const FieldRecipe& recipe);

/// A solid's field, and in words how it is stored.
struct StoredField {
  models::Model model;
  std::string method;
  std::vector<Note> notes;
};
Result<StoredField> stored_field(const Solid& solid, const FieldRecipe& recipe, const Work& work);

/// The scene of a solid: "field of INPUT, …".
Result<MadeScene> field_scene(Solid solid, const std::string& input, const FieldRecipe& recipe,
                              const Work& work);

}  // namespace palpable::recipes
