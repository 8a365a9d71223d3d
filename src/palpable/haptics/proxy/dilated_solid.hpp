// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/proxy/found_in_field.hpp"
#include "palpable/models/field/dense_line.hpp"
#include "palpable/models/field/distance_sample.hpp"
#include "palpable/models/field/distance_surface.hpp"
#include "palpable/models/field/outside_box.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace palpable::haptics {

/// The solid that the centre of a probe's ball cannot enter: a place's distance is that of the field less the
/// ball's radius. Refers to the field and to what its queries find. One thread. Tick path.
template <models::DistanceSurface Surface>
class DilatedSolid {
 public:
  /// Tolerance of places on the surface.
  static constexpr double kOn_m = 1e-6;
  /// The share of a field's distance that is certainly clear: far from the surface its gradient may be a
  /// fifth longer than 1.
  static constexpr double kSafe = 0.8;
  /// Evaluations to find the surface from a place near it, once.
  static constexpr int kSettling = 12;
  /// Whether first_dip() can be asked: the distance along a line is known exactly.
  static constexpr bool kHasExactLines = requires(const Surface& s) { models::first_dip(s, {}, {}, 0.0); };

  DilatedSolid(const Surface& field, double radius_m, FoundInField& found) noexcept
      : field_(field), radius_m_(radius_m), found_(found) {}

  models::DistanceSample sample(Vec3 place_m) const noexcept { return sample(place_m, found_.window); }

  /// Whether a hand is known to be inside, by an earlier sample_at_hand().
  bool is_known_inside(Vec3 hand_m) const noexcept {
    const double reach_m = kSafe * found_.inside_m;
    return squared_norm(hand_m - found_.inside_at_m) < reach_m * reach_m;
  }

  /// The sample at the hand. Remembers how far that is inside.
  models::DistanceSample sample_at_hand(Vec3 hand_m) const noexcept {
    // The hand is mostly not near the proxy, whose window is kept.
    models::FieldWindow window;
    const models::DistanceSample s = sample(hand_m, window);
    found_.inside_at_m = hand_m;
    found_.inside_m = std::max(0.0, -s.distance_m);
    return s;
  }

  /// A lower bound of the distance `distance_m` that sample() gave at a place. Outside a field's box what it
  /// gives is an upper bound.
  double certain_m(Vec3 place_m, double distance_m) const noexcept {
    if constexpr (requires(const Surface& s) { s.origin_m(), s.size_m(); }) {
      const Vec3 place = place_m - field_.origin_m();
      const Vec3 size = field_.size_m();
      if (models::nearest_in_box(place, size) != place)
        return models::least_outside_box(place, size, distance_m + radius_m_) - radius_m_;
    }
    return distance_m;
  }

  /// Whether a place is in the field's box.
  bool contains(Vec3 place_m) const noexcept { return field_.contains({place_m}); }
  /// models::first_dip() of the distance between two places in the field's box.
  std::optional<models::Dip> first_dip(Vec3 from_m, Vec3 to_m, double below_m) const noexcept {
    return models::first_dip(field_, {from_m}, {to_m}, below_m + radius_m_);
  }

  double cell_m() const noexcept { return field_.cell_m(); }

  /// Moves a place near the surface onto it along the gradient (Newton's method). `normal`: in, the normal at
  /// a nearby place, if known; out, the normal at the result. False if it does not converge: the field has no
  /// gradient there, or the place alternates between two faces of a crease. `evaluations` is reduced by those
  /// used; at least one must be left.
  bool settle(Vec3& place_m, Vec3& normal, int& evaluations) const noexcept {
    --evaluations;
    return settle_from(sample(place_m), place_m, normal, evaluations);
  }

  /// The same; `s` is the sample at the place.
  bool settle_from(models::DistanceSample s, Vec3& place_m, Vec3& normal, int& evaluations) const noexcept {
    for (;;) {
      const double length2 = squared_norm(s.gradient);
      if (!(length2 > 0.01)) return false;
      place_m -= (s.distance_m / length2) * s.gradient;
      const Vec3 last = normal;
      normal = s.gradient / std::sqrt(length2);
      const double off_m = std::abs(s.distance_m);
      // The error after a correction is at most the correction times the change of the normal along it, which
      // is estimated by the change since the last place.
      if (off_m * std::min(1.0, norm(normal - last)) < kOn_m) return true;
      if (evaluations <= 0) return off_m < kOff * cell_m();
      --evaluations;
      s = sample(place_m);
    }
  }

 private:
  /// A last correction of at most this many cells is accepted.
  static constexpr double kOff = 0.05;

  models::DistanceSample sample(Vec3 place_m, models::FieldWindow& window) const noexcept {
    const models::FieldSample s = asked(place_m, window);
    return {s.distance_m - radius_m_, s.gradient.v};
  }
  models::FieldSample asked(Vec3 place_m, models::FieldWindow& window) const noexcept {
    if constexpr (requires { field_.sample({place_m}, window); })
      return field_.sample({place_m}, window);
    else
      return field_.sample({place_m});
  }

  const Surface& field_;
  double radius_m_;
  FoundInField& found_;
};

}  // namespace palpable::haptics
