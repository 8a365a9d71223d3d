// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/note.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/recipes/solid/field_recipe.hpp"
#include "palpable/sculpt/field/dense_field_from_source.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <memory>
#include <string>
#include <vector>

namespace palpable::recipes {

using SceneFromInput = Transform<SceneFrame, models::InputFrame>;

/// The source of a field, in the scene's frame.
struct Solid {
  std::unique_ptr<sculpt::DistanceSource> distance;
  std::vector<Note> notes;
  SceneFromInput scene_from_input;
  models::SolidPose pose = models::SolidPose::upright;
  /// Accuracy of the input's own surface, metres; 0 = exact.
  double exact_to_m = 0.0;
  /// Its surface in words, to follow the name of the input; empty for the input's own.
  std::string surface;
  /// The superquadrics that the solid consists of, in the scene's frame; may be empty.
  std::vector<models::Superquadric> primitives;
  /// Places of the input mesh that are visible from outside (sculpt::visible_places()), in the scene's frame;
  /// empty for other inputs.
  std::vector<Vec3> visible_m;
};

/// The solid of a mesh, repaired if necessary.
Result<Solid> solid_of(Mesh mesh, const FieldRecipe& recipe, const Work& work);
Result<Solid> solid_of(std::vector<models::Superquadric> shapes, const FieldRecipe& recipe);
/// Makes what a mesh in the scene's frame encloses, repaired if necessary, the distance of `solid`, with the
/// notes of the repair. `cell_m`: the field's finest cells. Errors: as sculpt::solid_from_mesh().
Result<void> enclose(Solid& solid, const Mesh& mesh, double cell_m, const FieldRecipe& recipe,
                     const Work& work);
/// The solid of a contoured surface whose accuracy is `exact_to_m`, in units of the input.
Result<Solid> solid_of_contour(Mesh surface, double exact_to_m, const FieldRecipe& recipe);

/// A superquadric of the input, in the scene's frame.
models::Superquadric placed_in_scene(models::Superquadric shape, const SceneFromInput& scene_from_input);

/// The lattice of a dense field.
sculpt::DenseFieldOptions dense_options(const FieldRecipe& recipe);

/// A solid's field, and how it is stored, in words.
struct StoredField {
  models::Model model;
  std::string method;
  std::vector<Note> notes;
};
Result<StoredField> stored_field(const Solid& solid, const FieldRecipe& recipe, const Work& work);

}  // namespace palpable::recipes
