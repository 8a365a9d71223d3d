// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/models/field/superquadric.hpp"

#include <optional>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// A plane n·p = offset, n a unit vector.
struct Plane {
  Vec3 normal{0.0, 0.0, 1.0};
  double offset_m = 0.0;

  double height_m(Vec3 p) const { return dot(normal, p) - offset_m; }
};

/// The plane through the middle of at least three points that they are nearest to in the mean square.
Plane plane_through(std::span<const Vec3> points_m);

/// Root mean square of the points' heights over their own plane.
double thickness_m(std::span<const Vec3> points_m);

/// The members of the plane that holds the most points within `reach_m`, found by trying planes through three
/// of them (RANSAC, deterministic by `seed`); empty where it holds less than `least_share`.
std::vector<std::size_t> members_of_largest_plane(std::span<const Vec3> points_m, double reach_m,
                                                  double least_share, std::uint64_t seed);

/// A thin box whose front is the points' plane, in the smallest rectangle that holds 98 % of them along each
/// side: 2 % as thick as long, behind the plane as seen from `eye`, or around it.
models::Superquadric slab_of(std::span<const Vec3> points_m, const std::optional<Point<SceneFrame>>& eye);

}  // namespace palpable::sculpt
