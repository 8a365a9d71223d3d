// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/level_set.hpp"
#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/geometry/point_cloud.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/recipes/solid/predicted_solid.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/points/cloud_surface.hpp"
#include "palpable/sculpt/solid/thin_walls.hpp"
#include "palpable/sculpt/triangles/open_sheets.hpp"
#include "palpable/sculpt/triangles/placement.hpp"

#include <vector>

namespace palpable::recipes {

/// How a solid's distance is stored.
enum class FieldStorage {
  /// An octree of smooth pieces (models::DistanceField): small, exact and smooth.
  adaptive,
  /// The distance at every point of a lattice, for comparison.
  dense,
  /// The first representation of Moustakas et al. 2007: distance and force at every point, by fast marching.
  paper
};

/// Whose distance a solid's field is.
enum class SolidSurface {
  /// The solid's.
  given,
  /// That of superquadrics which are fitted to the solid.
  superquadrics,
  /// That of these superquadrics, corrected by the solid's surface (Moustakas et al. 2007).
  corrected
};

/// How a solid becomes a distance field.
struct FieldRecipe {
  /// Not given: the solid keeps its metres, axes and origin.
  sculpt::PlacementOptions placement;
  sculpt::FieldOptions field;
  FieldStorage storage = FieldStorage::adaptive;
  /// Of a mesh: how walls that are too thin for the field's cells are treated. Dense fields keep them
  /// unchanged.
  sculpt::WallOptions walls;
  /// Of a mesh: what is an open sheet rather than a body with holes.
  sculpt::OpenSheetOptions sheets;
  /// Of points: their surface.
  sculpt::CloudOptions cloud;
  SolidSurface surface = SolidSurface::given;
  /// Of other surfaces than the given one.
  PredictionOptions prediction = {};
};

/// Errors: usage for options out of range.
Result<void> check(const FieldRecipe& recipe);

// Each of these is long work for any thread: all threads are used, progress is reported, cancel is polled.
// Errors have no place: invalid_input for values that enclose no solid, usage for options out of range,
// failed for a field that needs too much memory, interrupted. Superquadrics are the surface of their field,
// whatever recipe.surface says; another solid's errors are also those of predicted_solid().

/// The field of the solid that a mesh encloses (sculpt::solid_from_mesh()).
Result<MadeScene> field_from_mesh(Mesh mesh, const FieldRecipe& recipe, const Work& work);

/// The same from points on a solid's surface. Missing normals are estimated, with a note.
Result<MadeScene> field_from_points(PointCloud cloud, const FieldRecipe& recipe, const Work& work);

/// The field of the exact distance of superquadrics, which are also stored in the scene as its primitives.
Result<MadeScene> field_from_superquadrics(std::vector<models::Superquadric> shapes,
                                           const FieldRecipe& recipe, const Work& work);

/// The field of a closed surface that superquadrics were corrected to (sculpt::correct_surface()); they are
/// stored as its primitives. The surface may fold: its solid is repaired as that of a mesh.
Result<MadeScene> field_from_corrected_shapes(Mesh surface, std::vector<models::Superquadric> predicted,
                                              const FieldRecipe& recipe, const Work& work);

/// The field of a level set's surface, resampled.
Result<MadeScene> field_from_level_set(const LevelSet& set, const FieldRecipe& recipe, const Work& work);

/// The volume behind the surface of a scene that is a relief (Park & Howard 2012), down to a base plate, as a
/// field. recipe.placement is not used. Errors: also usage for a scene of another kind.
Result<MadeScene> field_from_relief(MadeScene made, const FieldRecipe& recipe, const Work& work);

}  // namespace palpable::recipes
