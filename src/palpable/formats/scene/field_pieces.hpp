// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/distance_field.hpp"
#include "palpable/models/field/field_leaf.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace palpable::formats {

// Prediction for a field's streams (field_streams.hpp): curved pieces from recent pieces, planes from recent
// planes. Writer and reader keep the same history.

/// A leaf's position: its corner in finest cells, and its level.
struct LeafPosition {
  std::array<int, 3> corner{};
  int level = 0;

  double half() const { return 0.5 * (1 << level); }
  LeafPosition child(unsigned k) const;
};
LeafPosition root_position(const models::FieldGrid& grid, std::size_t index);

/// A quadratic in halves of its leaf's side: its middle, and l and Q (xx, yy, zz, xy, xz, yz).
struct QuadraticValues {
  double middle = 0.0;
  std::array<double, 9> numbers{};
};

/// A curved piece as integers (quantised).
struct Curved {
  static constexpr std::size_t kNumbers = 9;
  std::int32_t middle = 0;
  std::array<std::int32_t, kNumbers> numbers{};
};

/// The quantised piece of these words; nullopt if they are not multiples of the steps.
std::optional<Curved> steps_of(const std::uint32_t* words, int level);
/// Appends the words of a quantised piece.
void set_words(const Curved& curved, int level, std::vector<std::uint32_t>& words);

QuadraticValues values_of(const Curved& curved, int level);
QuadraticValues values_of(const models::CompactQuadratic& compact);
/// Quantises to the nearest steps of a curved piece at that level, or of a compact leaf.
Curved rounded_curved(const QuadraticValues& values, int level);
models::CompactQuadratic rounded_compact(const QuadraticValues& values);

/// The most recent quadratics, the latest first.
class RecentPieces {
 public:
  static constexpr std::size_t kMost = 4;
  void add(const QuadraticValues& piece, const LeafPosition& place);
  std::size_t count() const { return count_; }
  /// Piece k, extrapolated to the leaf at `place`. k < count().
  QuadraticValues predict(std::size_t k, const LeafPosition& place) const;

 private:
  std::array<std::pair<QuadraticValues, LeafPosition>, kMost> pieces_{};
  std::size_t count_ = 0;
};

using Plane = std::array<std::uint32_t, models::LeafHead::kPlaneWords>;

/// Planes in the order of their last use (move to front), the latest first; the oldest are dropped.
class RecentPlanes {
 public:
  /// The plane's position in that order: 1 for the latest, 0 if absent; moves it to the front.
  std::uint32_t rank(const Plane& plane);
  /// The plane of that rank, which moves to the front; nullopt for an unused rank.
  std::optional<Plane> take(std::uint32_t rank);
  void add(const Plane& plane);

 private:
  static constexpr std::size_t kMost = 1024;
  std::vector<Plane> planes_;
};

}  // namespace palpable::formats
