// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/distance_surface.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// How closely a field must follow its source (docs/fields.md). Near the surface: value within bound_m, and
/// root-mean-square and gradient so close that neighbouring leaves join without a perceptible step. Elsewhere
/// the same, loosened with the distance from that band.
struct FitBounds {
  double bound_m = 1e-5;
  /// The band: this deep inside and this far outside.
  double inside_m = 0.003;
  double outside_m = 0.001;
  double cell_m = 0.0;
  /// Over facets whose samples may turn by more (CellSamples::coarse_turn, radians), a leaf is tried as one
  /// smooth piece, in the compact form, before the edges between the facets: it is smaller.
  double noisy_turn = 0.03;
};

/// The tolerance of an edge's position, in finest cells.
inline constexpr double kKinkInCells = 0.1;

/// Where a cell is sampled: 3 x 3 x 3 places over it, its corners among them. Each gives a value and a
/// gradient, so 108 numbers determine the 10 of a quadratic.
inline constexpr std::size_t kFitPlaces = 27;
/// Place k of a cell, from its centre in halves of its side.
Vec3 fit_place(std::size_t k);

struct CellSamples {
  /// The cell's centre from the field's origin, and half its side.
  Vec3 centre_m;
  double half_m = 0.0;
  std::array<models::FieldSample, kFitPlaces> at;
  /// How far the samples may differ from the surface that they approximate (DistanceSource::Hint): a leaf
  /// need not follow them more closely.
  double coarse_m = 0.0, coarse_turn = 0.0;
  /// The cell is not split any further: if no leaf keeps the bounds, the search is for the one with the least
  /// error. For other cells the error of a leaf that fails is not computed to the end.
  bool is_last = true;
};

/// A leaf's words (models/field/field_leaf.hpp), and how far they err: up to 1 keeps every bound.
struct LeafFit {
  std::array<std::uint32_t, 24> words{};
  std::size_t count = 0;
  double error = std::numeric_limits<double>::infinity();
  std::span<const std::uint32_t> used() const { return {words.data(), count}; }
};

/// Leaves of planes that fitted cells nearby, the latest first: along an edge all cells hold the same one.
/// Planes do not depend on the cell, so a leaf that fits again is kept only once.
class RecentLeaves {
 public:
  void add(const LeafFit& leaf);
  std::span<const LeafFit> all() const { return {leaves_.data(), count_}; }

 private:
  static constexpr std::size_t kMost = 12;
  std::array<LeafFit, kMost> leaves_;
  std::size_t count_ = 0;
};

/// The simplest leaf that keeps the bounds: a plane, a recent leaf, two planes that meet, a quadratic, two of
/// them, three planes; else the best of these, its error above 1.
LeafFit fit_leaf(const CellSamples& samples, const FitBounds& bounds, const RecentLeaves& recent);

/// How far a leaf errs at one more place, as LeafFit::error counts it.
double leaf_error(const LeafFit& leaf, const CellSamples& samples, Vec3 u, const models::FieldSample& truth,
                  const FitBounds& bounds);

}  // namespace palpable::sculpt
