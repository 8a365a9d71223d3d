// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/blended_source.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace palpable::sculpt {
namespace {

constexpr std::uint32_t kNoPart = std::numeric_limits<std::uint32_t>::max();
/// In the transition neither distance is exact: an error of a part of their difference is allowed, and a
/// larger one of the direction, both decreasing towards the ends.
constexpr double kLoose = 0.05;

}  // namespace

using models::DistanceSample;

DistanceSample BlendedSource::earlier(Vec3 place_m) const {
  const models::FieldSample s = earlier_.sample({place_m});
  return {s.distance_m, s.gradient.v};
}

DistanceSample BlendedSource::at(Vec3 place_m, Hint& hint) const {
  if (!around_.any_within(place_m, within_m_, kNoPart)) return earlier(place_m);
  const DistanceSample now = source_.at(place_m, hint);
  const double depth_m = std::abs(now.distance_m);
  const double whole = now.distance_m < 0.0 ? whole_.inside : whole_.outside;
  // u <= whole, without a search for the nearest point of `around`.
  const double whole_from_m = within_m_ - depth_m * (1.0 - whole) / whole;
  if (whole_from_m > 0.0 && around_.any_within(place_m, whole_from_m, kNoPart)) return now;
  const DistanceSample old = earlier(place_m);
  const double difference_m = now.distance_m - old.distance_m;
  const NearestTriangle near = around_.nearest(place_m, hint.second_triangle);
  hint.second_triangle = near.triangle;
  const double s = std::sqrt(near.squared_distance_m2), left_m = within_m_ - s;
  const double u = depth_m / (depth_m + left_m);
  if (u <= whole) return now;
  hint.greatest_difference_m = std::max(hint.greatest_difference_m, std::abs(difference_m));
  const double v = (u - whole) / (1.0 - whole);
  const double share = 1.0 - v * v * (3.0 - 2.0 * v);
  const double share_by_u = -6.0 * v * (1.0 - v) / (1.0 - whole);
  const double loose = kLoose * std::min(1.0, 16.0 * share * (1.0 - share));
  hint.coarse_m += 0.6 * loose * std::abs(difference_m);
  hint.coarse_turn += loose;
  const Vec3 depth_slope = now.distance_m < 0.0 ? -1.0 * now.gradient : now.gradient;
  const Vec3 s_slope = s > 0.0 ? (place_m - near.point_m) / s : Vec3{};
  const Vec3 u_slope = (left_m * depth_slope + depth_m * s_slope) / ((depth_m + left_m) * (depth_m + left_m));
  return {old.distance_m + share * difference_m,
          old.gradient + share * (now.gradient - old.gradient) + (share_by_u * difference_m) * u_slope};
}

}  // namespace palpable::sculpt
