// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/recipes/video/video_model.hpp"
#include "palpable/sculpt/superquadric/superquadric_set.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::recipes {

/// How superquadrics approximate the model that a video shows.
struct ModelShapesOptions {
  /// Points belong to one object if they are connected above cells of the ground with this share of the
  /// model's extent, 0.001 … 0.1.
  double cell_share = 0.008;
  /// Objects with a smaller share of the points are left out, 0 … 0.5.
  double least_object_share = 0.004;
  /// Thickness of the base plate, share of the model's extent, 0.005 … 0.5.
  double base_share = 0.03;
  /// Cells are at least this many mean spacings of points wide, so that none of an object's stays empty, 0
  /// … 20.
  double cell_spacings = 2.5;
  /// Least number of points in a cell of an object, 1 … 100.
  int least_in_cell = 2;
  sculpt::ShapeSetOptions shapes;
};
std::vector<Parameter> parameters_of(ModelShapesOptions& options);

/// Superquadrics of a video's model, in the ground's axes.
struct ModelShapes {
  /// The base plate first.
  std::vector<models::Superquadric> shapes;
  std::size_t objects = 0;
};

/// The first approximation of Moustakas et al. 2007: the table becomes a plate, and each object on it one or
/// more superquadrics. The points of an object and their feet on the table, which close its sides, are fitted
/// (sculpt::fit_superquadrics()). A model without anything raised is its plate. Deterministic. Long work.
/// Errors: usage for options out of range; as fit_superquadrics().
Result<ModelShapes> shapes_of_model(const VideoModel& model, const ModelShapesOptions& options,
                                    const Work& work);

}  // namespace palpable::recipes
