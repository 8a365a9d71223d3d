// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/sculpt/points/plane_fit.hpp"

#include <optional>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// Options for finding planes and shaping slabs.
struct SlabOptions {
  /// Random triples of points that are tried, and points that each plane is compared with. 1 … 1e6 each.
  int trials = 200;
  int sampled_points = 500;
  /// Thickness of a slab over its longer side. 0.0001 … 1.
  double thickness = 0.02;
  /// Directions that are tried for its sides, over a quarter turn. 1 … 1000.
  int directions = 45;
};

std::vector<Parameter> parameters_of(SlabOptions& options);

/// Root mean square of the points' heights over the plane through them.
double thickness_m(std::span<const Vec3> points_m);

/// The points within `reach_m` of the plane with most such points (RANSAC, deterministic for a seed); empty
/// if they are less than `least_share` of all.
std::vector<std::size_t> members_of_largest_plane(std::span<const Vec3> points_m, double reach_m,
                                                  double least_share, const SlabOptions& options,
                                                  std::uint64_t seed);

/// A thin box over the points' plane: the smallest rectangle that contains the middle 98 % of them along each
/// side. Its front is the plane as seen from `eye`; without an eye the plane is in its middle.
models::Superquadric slab_of(std::span<const Vec3> points_m, const std::optional<Point<SceneFrame>>& eye,
                             const SlabOptions& options);

}  // namespace palpable::sculpt
