// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/field/distance_field.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace palpable::formats {

/// A field's tree as byte streams, each of one kind of data, which compress far better than the tree itself.
/// The streams contain no indices or offsets, so a damaged file cannot build an invalid tree.
struct FieldStreams {
  static constexpr std::size_t kCount = 11;
  /// Number of streams in files from before compact leaves.
  static constexpr std::size_t kCountBefore = 9;
  enum Name : std::size_t {
    /// Entries, depth first: 0 a node, 1 a leaf.
    tree,
    /// For each leaf: how many leaves ago the same content occurred, 0 = new content.
    shared,
    /// The heads of new leaves.
    heads,
    /// For each plane: its rank among the recent planes, 0 = a new plane.
    plane_ranks,
    /// New planes, as four byte planes.
    planes,
    /// For each quadratic: the recent piece that it is predicted from.
    predictions,
    /// Residuals of the curved pieces' middles and of their nine numbers; low and high bytes apart.
    middles,
    shapes,
    /// Curved pieces that are not multiples of the steps (models/field/field_leaf.hpp), unchanged.
    raw,
    /// Residuals of the compact leaves' middles, and of their nine numbers.
    compact_middles,
    compact_numbers
  };
  std::array<std::vector<std::uint8_t>, kCount> bytes;
};

FieldStreams streams_of(const models::FieldGrid& grid, const models::FieldTree& tree);

/// Decodes the same tree. `grid` must be valid. Errors: invalid_input for inconsistent streams.
Result<models::FieldTree> tree_from(const models::FieldGrid& grid, const FieldStreams& streams);

}  // namespace palpable::formats
