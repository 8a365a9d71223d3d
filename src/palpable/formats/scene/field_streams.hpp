// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/field/distance_field.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace palpable::formats {

/// A field's tree as streams of bytes of one kind each, which pack far better than the tree itself:
/// entries (0 a node, 1 a leaf), depth first; for each leaf how many leaves ago the same content was met
/// (0: new); the new leaves' heads; for each plane how recently it was met (0: new); new planes in four byte
/// planes; for each curved piece what it is predicted from; how far its middle and its nine numbers are from
/// that prediction, number by number, low bytes and high bytes apart; and curved pieces that are no multiples
/// of the steps (models/field/field_leaf.hpp), as they are; and of compact leaves, which are predicted in the
/// same way, the middles and the nine numbers. No number leads anywhere by itself, so a damaged
/// file cannot build a tree that is not one.
struct FieldStreams {
  static constexpr std::size_t kCount = 11;
  /// Of files that were written before there were compact leaves.
  static constexpr std::size_t kCountBefore = 9;
  enum Name : std::size_t {
    tree,
    shared,
    heads,
    plane_ranks,
    planes,
    predictions,
    middles,
    shapes,
    raw,
    compact_middles,
    compact_numbers
  };
  std::array<std::vector<std::uint8_t>, kCount> bytes;
};

FieldStreams streams_of(const models::FieldGrid& grid, const models::FieldTree& tree);

/// The same tree. `grid` is sound. Errors: invalid_input for streams that do not fit together.
Result<models::FieldTree> tree_from(const models::FieldGrid& grid, const FieldStreams& streams);

}  // namespace palpable::formats
