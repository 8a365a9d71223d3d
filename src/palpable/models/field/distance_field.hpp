// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/field/distance_sample.hpp"
#include "palpable/models/field/distance_surface.hpp"
#include "palpable/models/field/field_errors.hpp"
#include "palpable/models/field/field_window.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::models {

/// The box of cells of a field. Positions in the field are measured in its finest cells.
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

/// A field's octree without pointers, in nearly the same form as in its file.
struct FieldTree {
  /// An entry is a leaf (kLeaf set, the rest is the index of its words) or a node (the index of its eight
  /// entries).
  static constexpr std::uint32_t kLeaf = 0x80000000U;
  /// One entry per root cell, x fastest, then y, then z.
  std::vector<std::uint32_t> roots;
  /// Eight entries per node, indexed by x in bit 0, y in bit 1, z in bit 2. A node's children come after it.
  std::vector<std::uint32_t> nodes;
  /// The contents of leaves (field_leaf.hpp); equal contents are shared.
  std::vector<std::uint32_t> words;
};

/// An adaptively sampled distance field (Frisken et al. 2000, used by Moustakas et al. 2007). A leaf of the
/// octree holds exact planes, edges and corners, or quadratic polynomials, within an error bound;
/// neighbouring leaves need not agree. A query averages the leaves under a small moving window: a product of
/// tent functions that reach half a finest cell to each side. The leaves' weights are piecewise quadratic and
/// sum to 1. So distance and gradient are continuous for any leaves, and away from faces the average is the
/// leaf itself. The gradient is the exact derivative of the distance. Immutable; any thread.
class DistanceField {
 public:
  /// Validates everything that queries rely on. Errors: invalid_input.
  static Result<DistanceField> from_tree(const FieldGrid& grid, FieldTree tree, const FieldErrors& errors);

  /// At any finite position; outside the grid by outside_box(). Tick path.
  FieldSample sample(Point<SceneFrame> place) const noexcept;
  /// The same, to the last bit. The leaves are those in `window` if that is the window of the place, else
  /// they are searched and left there: for places that follow each other.
  FieldSample sample(Point<SceneFrame> place, FieldWindow& window) const noexcept;

  bool contains(Point<SceneFrame> place) const noexcept;
  const FieldGrid& grid() const noexcept { return grid_; }
  const FieldTree& tree() const noexcept { return tree_; }
  const FieldErrors& errors() const noexcept { return errors_; }
  double cell_m() const noexcept { return grid_.cell_m; }
  /// The grid's box.
  Vec3 origin_m() const noexcept { return grid_.origin_m; }
  Vec3 size_m() const noexcept { return grid_.size_m(); }
  std::size_t leaves() const noexcept { return leaves_; }
  std::size_t memory_bytes() const noexcept;

  /// A leaf's corner and side in finest cells, and the index of its words.
  struct Leaf {
    std::array<int, 3> corner;
    int side;
    std::uint32_t words;
  };
  /// The leaf that contains a finest cell of the grid. Tick path.
  Leaf leaf_of(int x, int y, int z) const noexcept;

  /// Half of the width within which a kink between two pieces is rounded, in finest cells.
  static constexpr double kRounding = 0.5;

 private:
  DistanceField() = default;
  /// The path down to a finest cell: the entry at each level.
  struct Descent;
  /// The words of the leaf that contains a finest cell, and in `path` its level; reuses the entries that its
  /// path shares with the previous one.
  std::uint32_t down_to(int x, int y, int z, Descent& path) const noexcept;
  /// The leaves under the window of a place in the grid, in finest cells.
  void find_leaves(Vec3 cells, FieldWindow& window) const noexcept;
  DistanceSample leaf_sample(const FieldWindow& window, std::size_t k, Vec3 cells) const noexcept;
  DistanceSample average_of_two(Vec3 cells, const FieldWindow& window,
                                const std::array<double, 3>& over_corner) const noexcept;
  /// The average under the window of a place.
  DistanceSample averaged(Vec3 cells, const FieldWindow& window) const noexcept;
  FieldSample sample_outside(Point<SceneFrame> place, FieldWindow& window) const noexcept;

  FieldGrid grid_;
  FieldTree tree_;
  FieldErrors errors_;
  std::size_t leaves_ = 0;
  double cells_per_m_ = 0.0;
  double round_m_ = 0.0;
};

}  // namespace palpable::models
