// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/distance_field.hpp"
#include "palpable/models/field/field_leaf.hpp"
#include "palpable/sculpt/field/leaf_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace palpable::sculpt {

/// The allowed error at a point: its maximum, and its root mean square over a leaf.
struct Allowance {
  double value_m = 0.0;
  double value_rms_m = 0.0;
  double gradient = 0.0;
  double gradient_rms = 0.0;
};

/// Allowed error of a leaf outside the band, in finest cells. It is limited because differences between
/// neighbours also affect the gradient of their blend.
inline constexpr double kJoinInCells = 0.2;
inline constexpr double kJoinRmsInCells = 0.06;
/// Allowed deviation of the gradient's length from 1; larger far outside the band.
inline constexpr double kLength = 0.04, kLengthOutside = 0.2;

/// The allowance in a leaf with a side of `side` finest cells. Small facets of a curved surface should not be
/// represented one by one: the gradient is tested by its mean, and less strictly if the leaf is hardly larger
/// than its kink.
inline Allowance allowance(double distance_m, double side, const FitBounds& b) {
  const double loose = side < 3.0 ? 4.0 : side < 6.0 ? 2.0 : 1.0;
  // Neighbouring leaves that differ by 2 rms over half a cell tilt the gradient by 1 % to 2 %.
  Allowance a{b.bound_m, std::min(0.15 * b.bound_m, 0.006 * b.cell_m), 0.035 * loose, 0.01 * loose};
  const double beyond =
      distance_m < 0.0 ? (-distance_m - b.inside_m) / b.inside_m : (distance_m - b.outside_m) / b.outside_m;
  if (beyond <= 0.0) return a;
  const double more = distance_m < 0.0 ? 1.0 + 4.0 * std::min(beyond, 1.0) : 1.0 + 10.0 * beyond;
  a.value_m = std::max(a.value_m, std::min(a.value_m * more, kJoinInCells * b.cell_m));
  a.value_rms_m = std::max(a.value_rms_m, std::min(a.value_rms_m * more, kJoinRmsInCells * b.cell_m));
  const double turned = distance_m < 0.0 ? 1.0 + std::min(beyond, 2.0) : 1.0 + 4.0 * std::min(beyond, 4.0);
  a.gradient *= turned;
  a.gradient_rms *= turned;
  return a;
}

/// Computes the errors of a leaf at its sample points.
class LeafErrors {
 public:
  LeafErrors(const CellSamples& samples, const FitBounds& bounds)
      : samples_(samples),
        bounds_(bounds),
        round_m_(models::DistanceField::kRounding * bounds.cell_m),
        side_(2.0 * samples.half_m / bounds.cell_m) {}

  /// Sums of squared errors over their allowances.
  struct Squares {
    double value = 0.0;
    double gradient = 0.0;
    double greater() const { return std::max(value, gradient); }
  };

  /// The greater of value and gradient error over their allowances at one place; adds to the squares.
  double at(const LeafFit& leaf, Vec3 u, const models::DistanceSample& truth, Squares& squares) const {
    const Vec3 x = samples_.centre_m + samples_.half_m * u;
    const std::uint32_t* words = leaf.words.data();
    const double sharp_round_m = 1e-3 * round_m_;
    models::DistanceSample s, sharp;
    models::visit_pieces(words, x, u, samples_.half_m, [&](int i, const models::DistanceSample& piece) {
      sharp = i == 0 ? piece : models::joined_by(words, i, sharp, piece, sharp_round_m);
      s = i == 0 ? piece : models::joined_by(words, i, s, piece, round_m_);
    });
    Allowance a = allowance(truth.distance_m, side_, bounds_);
    a.value_m += samples_.coarse_m;
    a.value_rms_m += 0.5 * samples_.coarse_m;
    a.gradient += samples_.coarse_turn;
    a.gradient_rms += 0.5 * samples_.coarse_turn;
    // Near a rounded kink the gradient turns, and the rounding's own error is allowed; but the kink must be
    // at its true position.
    if (std::abs(sharp.distance_m - s.distance_m) > sharp_round_m)
      return std::abs(sharp.distance_m - truth.distance_m) /
             std::max(a.value_m, kKinkInCells * bounds_.cell_m);
    const double value = std::abs(s.distance_m - truth.distance_m);
    const double turned2 = squared_norm(s.gradient - truth.gradient);
    squares.value += value * value / (a.value_rms_m * a.value_rms_m);
    squares.gradient += turned2 / (a.gradient_rms * a.gradient_rms);
    const double length = truth.distance_m > bounds_.outside_m ? kLengthOutside : kLength;
    const double longer = std::abs(norm(s.gradient) - 1.0) / (length + samples_.coarse_turn);
    return std::max({value / a.value_m, std::sqrt(turned2) / a.gradient, longer});
  }

  /// The greatest error of the distance, over all places; infinite as error(). Gives up at `enough_m`. Begins
  /// with the place where the last leaf was farthest off: most leaves of a cell fail at the same place.
  double greatest_m(const LeafFit& leaf, double enough_m) {
    double greatest = 0.0;
    const std::size_t first = worst_place_;
    for (std::size_t i = 0; i < kFitPlaces && greatest < enough_m; ++i) {
      const std::size_t k = (first + i) % kFitPlaces;
      const Vec3 u = fit_place(k);
      const Vec3 x = samples_.centre_m + samples_.half_m * u;
      const double distance = models::leaf_at(leaf.words.data(), x, u, samples_.half_m, round_m_).distance_m;
      if (!std::isfinite(distance)) return std::numeric_limits<double>::infinity();
      const double error = std::abs(distance - samples_.at[k].distance_m);
      if (error <= greatest) continue;
      greatest = error;
      worst_place_ = k;
    }
    return greatest;
  }
  /// Whether the cell cannot be split further.
  bool is_finest() const { return side_ < 1.5; }
  bool may_be_compact() const { return side_ < 1.5 * (1 << models::CompactQuadratic::kMostLevel); }

  /// The greatest error over all points; stops above `enough`. Infinite if a leaf gives a value that is not
  /// finite.
  double error(const LeafFit& leaf, double enough) const {
    double worst = 0.0;
    Squares squares;
    const double enough2 = enough * enough * kFitPlaces;
    for (std::size_t k = 0; k < kFitPlaces && worst <= enough && squares.greater() <= enough2; ++k) {
      const double here = at(leaf, fit_place(k), samples_.at[k], squares);
      if (!std::isfinite(here)) return std::numeric_limits<double>::infinity();
      worst = std::max(worst, here);
    }
    return std::max(worst, std::sqrt(squares.greater() / kFitPlaces));
  }

 private:
  const CellSamples& samples_;
  const FitBounds& bounds_;
  double round_m_;
  double side_;
  std::size_t worst_place_ = 0;
};

}  // namespace palpable::sculpt
