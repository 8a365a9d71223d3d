// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/field/distance_surface.hpp"
#include "palpable/models/field/field_errors.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::models {

/// The box of cells that a field is sampled in. All of the field's places are counted in its finest cells.
struct FieldGrid {
  /// The corner with the least coordinates.
  Vec3 origin_m;
  /// Side of the finest cell, 1e-6 ... 1 m.
  double cell_m = 0.0;
  /// A root cell is 2^levels finest cells long, 0 <= levels <= 10.
  int levels = 0;
  /// Root cells along x, y and z, each >= 1; at most 2^24 in all, and 2^20 finest cells along each axis.
  std::array<int, 3> roots{};

  int cells(std::size_t axis) const noexcept { return roots[axis] << levels; }
  Vec3 size_m() const noexcept { return {cell_m * cells(0), cell_m * cells(1), cell_m * cells(2)}; }
};

/// What a field is made of, without pointers: as it lies in memory, and nearly so in its file.
struct FieldTree {
  /// An entry is a leaf (kLeaf set: where its words begin) or a node (the number of its eight entries).
  static constexpr std::uint32_t kLeaf = 0x80000000U;
  /// One entry per root cell, x fastest, then y, then z.
  std::vector<std::uint32_t> roots;
  /// Eight entries per node: x in bit 0 of the place, y in bit 1, z in bit 2. A node's children come after
  /// it.
  std::vector<std::uint32_t> nodes;
  /// Leaves' contents (field_leaf.hpp); leaves that hold the same share it.
  std::vector<std::uint32_t> words;
};

/// An adaptively sampled distance field (Frisken et al. 2000, as Moustakas et al. 2007 keep theirs). An
/// octree's leaf holds exact planes, edges and corners, or quadratic polynomials, each with its own error
/// bound; no two leaves need to agree. What is felt is their mean under a small moving window: a product of
/// tents that reach half a finest cell to each side. The windows' shares are piecewise quadratic and sum to
/// 1, so distance and gradient are continuous everywhere whatever the leaves hold, and in the middle of a
/// leaf the mean is the leaf itself. The gradient is the exact derivative of the distance. Immutable; any
/// thread.
class DistanceField {
 public:
  /// Checks everything that a query relies on. Errors: invalid_input.
  static Result<DistanceField> from_tree(const FieldGrid& grid, FieldTree tree, const FieldErrors& errors);

  /// At any finite place. Outside the grid: the distance at the nearest place of the grid plus the way there,
  /// continuous, for a hand that comes from afar. Tick path.
  FieldSample sample(Vec3 place_m) const noexcept;

  bool contains(Vec3 place_m) const noexcept;
  const FieldGrid& grid() const noexcept { return grid_; }
  const FieldTree& tree() const noexcept { return tree_; }
  const FieldErrors& errors() const noexcept { return errors_; }
  double cell_m() const noexcept { return grid_.cell_m; }
  /// Of the grid's box.
  Vec3 origin_m() const noexcept { return grid_.origin_m; }
  Vec3 size_m() const noexcept { return grid_.size_m(); }
  std::size_t leaves() const noexcept { return leaves_; }
  std::size_t memory_bytes() const noexcept;

  /// A leaf's place in finest cells and its side.
  struct Leaf {
    std::array<int, 3> corner;
    int side;
    std::uint32_t words;
  };
  /// The leaf that holds a finest cell inside the grid. Tick path.
  Leaf leaf_of(int x, int y, int z) const noexcept;

  /// Half the width in which a kink between two pieces is rounded, in finest cells.
  static constexpr double kRounding = 0.5;

 private:
  DistanceField() = default;
  FieldSample leaf_sample(const Leaf& leaf, Vec3 cells) const noexcept;
  /// The way down to a finest cell: the entry at each level, as far as the last one.
  struct Descent;
  /// The leaf that holds a finest cell, from where the last way parted from this one: above, the entries are
  /// the same.
  Leaf down_to(int x, int y, int z, Descent& way) const noexcept;
  /// Where the window reaches out of the leaf `home`, to which `way` led.
  FieldSample mixed(Vec3 cells, const Leaf& home, Descent& way) const noexcept;

  FieldGrid grid_;
  FieldTree tree_;
  FieldErrors errors_;
  std::size_t leaves_ = 0;
  double cells_per_m_ = 0.0;
  double round_m_ = 0.0;
};

}  // namespace palpable::models
