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

// What a field's streams (field_streams.hpp) predict from what came before: curved pieces from their
// neighbours', planes from those met lately. The writer and the reader remember the same.

/// Where a leaf stands: its corner in finest cells, and its level.
struct Place {
  std::array<int, 3> corner{};
  int level = 0;

  double half() const { return 0.5 * (1 << level); }
  Place child(unsigned k) const;
};
Place root_place(const models::FieldGrid& grid, std::size_t index);

/// A quadratic in halves of its leaf's side: its middle, and l and Q (xx, yy, zz, xy, xz, yz).
struct QuadraticValues {
  double middle = 0.0;
  std::array<double, 9> numbers{};
};

/// A curved piece in whole steps.
struct Curved {
  static constexpr std::size_t kNumbers = 9;
  std::int32_t middle = 0;
  std::array<std::int32_t, kNumbers> numbers{};
};

/// A piece's words as steps; nothing for words that are no whole steps.
std::optional<Curved> steps_of(const std::uint32_t* words, int level);
/// Appends the words.
void set_words(const Curved& curved, int level, std::vector<std::uint32_t>& words);

QuadraticValues values_of(const Curved& curved, int level);
QuadraticValues values_of(const models::CompactQuadratic& compact);
/// To the nearest steps of a curved piece at that level, and of a compact leaf.
Curved rounded_curved(const QuadraticValues& values, int level);
models::CompactQuadratic rounded_compact(const QuadraticValues& values);

/// The last quadratics, the latest first.
class RecentPieces {
 public:
  static constexpr std::size_t kMost = 4;
  void add(const QuadraticValues& piece, const Place& place);
  std::size_t count() const { return count_; }
  /// Piece k, continued into the leaf at `place`. k < count().
  QuadraticValues predict(std::size_t k, const Place& place) const;

 private:
  std::array<std::pair<QuadraticValues, Place>, kMost> pieces_{};
  std::size_t count_ = 0;
};

using Plane = std::array<std::uint32_t, models::LeafHead::kPlaneWords>;

/// Planes in the order in which they were last met, the latest first; the oldest are forgotten.
class RecentPlanes {
 public:
  /// 1 for the latest, 0 for none; moves it to the front.
  std::uint32_t rank(const Plane& plane);
  /// The plane of that rank, which moves to the front; nothing for a rank that none has.
  std::optional<Plane> take(std::uint32_t rank);
  void add(const Plane& plane);

 private:
  static constexpr std::size_t kMost = 1024;
  std::vector<Plane> planes_;
};

}  // namespace palpable::formats
