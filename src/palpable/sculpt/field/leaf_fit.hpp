// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/distance_sample.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// Tolerances of a field relative to its source (docs/fields.md). Near the surface, the value is within
/// bound_m, and RMS and gradient errors are so small that neighbouring leaves join without a perceptible
/// step. Elsewhere the tolerances increase with the distance from that band.
struct FitBounds {
  double bound_m = 1e-5;
  /// The band: this deep inside and this far outside.
  double inside_m = 0.003;
  double outside_m = 0.001;
  double cell_m = 0.0;
  /// If the samples of facets may deviate by more than this angle (CellSamples::coarse_turn, radians), one
  /// smooth piece in the compact form is tried before the edges between the facets, since it is smaller.
  double noisy_turn = 0.03;
};

/// The tolerance of an edge's position, in finest cells.
inline constexpr double kKinkInCells = 0.1;

/// Sample points of a cell: 3 x 3 x 3, corners included. Each gives a value and a gradient, so 108 numbers
/// determine the 10 of a quadratic.
inline constexpr std::size_t kFitPlaces = 27;
/// Sample point k relative to the cell's centre, in halves of its side.
inline Vec3 fit_place(std::size_t k) {
  const auto axis = [](std::size_t i) { return static_cast<double>(i % 3) - 1.0; };
  return {axis(k), axis(k / 3), axis(k / 9)};
}

struct CellSamples {
  /// The cell's centre from the field's origin, and half its side.
  Vec3 centre_m;
  double half_m = 0.0;
  std::array<models::DistanceSample, kFitPlaces> at;
  /// Accuracy of the samples as an approximation of the surface (DistanceSource::Hint); a leaf need not be
  /// more accurate.
  double coarse_m = 0.0, coarse_turn = 0.0;
  /// Whether the cell cannot be split further. Then, if no leaf satisfies the bounds, the one with the least
  /// error is searched. For other cells the error of a failing leaf is not computed completely.
  bool is_last = true;
};

/// A leaf's words (models/field/field_leaf.hpp) and its relative error: up to 1 satisfies all bounds.
struct LeafFit {
  std::array<std::uint32_t, 24> words{};
  std::size_t count = 0;
  double error = std::numeric_limits<double>::infinity();
  std::span<const std::uint32_t> used() const { return {words.data(), count}; }
};

/// Plane leaves that fitted nearby cells, the latest first: along an edge all cells have the same one. Planes
/// do not depend on the cell, so a repeated leaf is stored only once.
class RecentLeaves {
 public:
  void add(const LeafFit& leaf);
  std::span<const LeafFit> all() const { return {leaves_.data(), count_}; }

 private:
  static constexpr std::size_t kMost = 12;
  std::array<LeafFit, kMost> leaves_;
  std::size_t count_ = 0;
};

/// Fits the simplest leaf that satisfies the bounds: a plane, a recent leaf, two planes that meet, a
/// quadratic, two quadratics, three planes; else the best of these, with an error above 1.
LeafFit fit_leaf(const CellSamples& samples, const FitBounds& bounds, const RecentLeaves& recent);

/// The relative error of a leaf at one more point, as in LeafFit::error.
double leaf_error(const LeafFit& leaf, const CellSamples& samples, Vec3 u,
                  const models::DistanceSample& truth, const FitBounds& bounds);

}  // namespace palpable::sculpt
