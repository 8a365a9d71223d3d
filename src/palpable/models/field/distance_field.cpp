// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/distance_field.hpp"

#include "palpable/models/field/field_leaf.hpp"
#include "palpable/models/field/outside_box.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace palpable::models {
namespace {

constexpr int kMostLevels = 10;
constexpr std::size_t kMostRoots = std::size_t{1} << 24U;

bool grid_is_valid(const FieldGrid& grid) {
  if (!is_finite(grid.origin_m) || !(grid.cell_m >= 1e-6 && grid.cell_m <= 1.0)) return false;
  if (grid.levels < 0 || grid.levels > kMostLevels) return false;
  std::size_t count = 1;
  for (const int n : grid.roots) {
    if (n < 1 || n > (1 << 20) >> grid.levels) return false;
    count *= static_cast<std::size_t>(n);
    if (count > kMostRoots) return false;
  }
  return true;
}

/// Whether the words from `at` on are a complete leaf with finite values.
bool leaf_is_valid(const std::vector<std::uint32_t>& words, std::size_t at) {
  if (at >= words.size()) return false;
  const LeafHead head{words[at]};
  // All values of the other bits are finite numbers.
  if (head.compact()) return (head.bits & 0x7FU) == 4U && at + head.words() <= words.size();
  if (head.pieces() > 3 || head.bits >> 7U != 0 || at + head.words() > words.size()) return false;
  const std::uint32_t* next = &words[at] + 1;
  for (int i = 1; i < head.pieces(); ++i, next += 2) {
    const double cosine = detail::f64(next[0]);
    const double sine = detail::f64(next[1]);
    if (!(cosine >= 0.0 && cosine <= 1.0 && sine >= 1e-3 && sine <= 1.0)) return false;
  }
  for (int i = 0; i < head.pieces(); ++i) {
    const std::size_t floats = head.curved(i) ? 1 : LeafHead::kPlaneWords;
    for (std::size_t k = 0; k < floats; ++k)
      if (!(std::abs(detail::f64(next[k])) < 1e9)) return false;
    next += head.curved(i) ? LeafHead::kCurvedWords : LeafHead::kPlaneWords;
  }
  return true;
}

/// Checks that every entry refers to a valid leaf or to its own node one level deeper; returns the number of
/// leaves.
Result<std::size_t> checked_leaves(const FieldGrid& grid, const FieldTree& tree) {
  const Error damaged = invalid_input("holds a field whose cells are damaged");
  const std::size_t roots = static_cast<std::size_t>(grid.roots[0]) *
                            static_cast<std::size_t>(grid.roots[1]) * static_cast<std::size_t>(grid.roots[2]);
  if (tree.roots.size() != roots || tree.nodes.size() % 8 != 0) return damaged;
  const std::size_t nodes = tree.nodes.size() / 8;
  // The level of the entry that refers to each node; parents come before their children.
  std::vector<std::int8_t> level(nodes, std::int8_t{-1});
  std::size_t leaves = 0;
  const auto check = [&](std::uint32_t entry, int entry_level, std::size_t after) {
    if ((entry & FieldTree::kLeaf) != 0) {
      ++leaves;
      return leaf_is_valid(tree.words, entry & ~FieldTree::kLeaf);
    }
    if (entry >= nodes || entry < after || entry_level < 1 || level[entry] != -1) return false;
    level[entry] = static_cast<std::int8_t>(entry_level);
    return true;
  };
  for (const std::uint32_t entry : tree.roots)
    if (!check(entry, grid.levels, 0)) return damaged;
  for (std::size_t node = 0; node < nodes; ++node) {
    if (level[node] < 1) return damaged;
    for (std::size_t i = 0; i < 8; ++i)
      if (!check(tree.nodes[8 * node + i], level[node] - 1, node + 1)) return damaged;
  }
  return leaves;
}

/// The share of the window above a face, and its derivative per cell. The window reaches 0.5 finest cells to
/// each side.
struct Share {
  double upper = 0.0;
  double slope = 0.0;
};
Share share_above(double place_over_face) {
  const double t = 2.0 * place_over_face;
  const double rest = 1.0 - std::abs(t);
  return {t < 0.0 ? 0.5 * rest * rest : 1.0 - 0.5 * rest * rest, 2.0 * rest};
}

/// Prefetches a leaf's words; a compact leaf may span two cache lines.
void prefetch(const std::uint32_t* words) {
  __builtin_prefetch(words);
  __builtin_prefetch(words + LeafHead::kCompactWords - 1);
}

std::size_t root_index(const FieldGrid& grid, int x, int y, int z) {
  const int level = grid.levels;
  return static_cast<std::size_t>((z >> level) * grid.roots[1] + (y >> level)) *
             static_cast<std::size_t>(grid.roots[0]) +
         static_cast<std::size_t>(x >> level);
}

/// The part of the window on one side of the nearest face: its finest cell, share, and derivative per cell.
struct WindowSide {
  int cell = 0;
  double share = 0.0, slope = 0.0;
};
/// The part of the window within a leaf along one axis: its share, derivative per cell, and the octants of
/// the window that lie on its sides, one bit each.
struct WindowShare {
  double share = 0.0, slope = 0.0;
  unsigned octants = 0;
};
/// Below and above that face along one axis: the window crosses at most one.
struct WindowSides {
  std::array<WindowSide, 2> side;

  WindowSides(double place, int cells) {
    const int face = static_cast<int>(place + 0.5);
    const Share share = share_above(place - face);
    side[0] = {std::max(face - 1, 0), 1.0 - share.upper, -share.slope};
    side[1] = {std::min(face, cells - 1), share.upper, share.slope};
  }
  bool is_in(const DistanceField::Leaf& leaf, std::size_t axis) const {
    return side[0].cell >= leaf.corner[axis] && side[1].cell < leaf.corner[axis] + leaf.side;
  }
  WindowShare within(const DistanceField::Leaf& leaf, std::size_t axis) const {
    constexpr std::array kBelow{0x55U, 0x33U, 0x0FU};
    if (is_in(leaf, axis)) return {1.0, 0.0, 0xFFU};
    const bool is_below = side[0].cell >= leaf.corner[axis] && side[0].cell < leaf.corner[axis] + leaf.side;
    const WindowSide& one = side[is_below ? 0 : 1];
    return {one.share, one.slope, is_below ? kBelow[axis] : ~kBelow[axis]};
  }
  /// The side that is not in a leaf that holds the other.
  const WindowSide& out_of(const DistanceField::Leaf& leaf, std::size_t axis) const {
    return side[1].cell >= leaf.corner[axis] + leaf.side ? side[1] : side[0];
  }
};

/// The only axis along which the window leaves a leaf; 3 if there is none or more than one.
std::size_t only_axis_out_of(const DistanceField::Leaf& leaf, const std::array<WindowSides, 3>& sides) {
  const bool x = sides[0].is_in(leaf, 0), y = sides[1].is_in(leaf, 1), z = sides[2].is_in(leaf, 2);
  if (!x && y && z) return 0;
  if (x && !y && z) return 1;
  return x && y && !z ? 2 : 3;
}

/// The samples of the only two leaves under the window, that of the second weighted with `side`.
DistanceSample blended(const DistanceSample& a, const DistanceSample& b, const WindowSide& side,
                       std::size_t axis, double cells_per_m) {
  const double difference_m = b.distance_m - a.distance_m;
  DistanceSample sample{a.distance_m + side.share * difference_m,
                        a.gradient + side.share * (b.gradient - a.gradient)};
  const double along = side.slope * difference_m * cells_per_m;
  (axis == 0 ? sample.gradient.x : axis == 1 ? sample.gradient.y : sample.gradient.z) += along;
  return sample;
}

}  // namespace

Result<DistanceField> DistanceField::from_tree(const FieldGrid& grid, FieldTree tree,
                                               const FieldErrors& errors) {
  if (!grid_is_valid(grid)) return invalid_input("contains a field with an invalid grid");
  const auto leaves = checked_leaves(grid, tree);
  if (!leaves) return leaves.error();
  DistanceField field;
  field.grid_ = grid;
  field.tree_ = std::move(tree);
  field.errors_ = errors;
  field.leaves_ = *leaves;
  field.cells_per_m_ = 1.0 / grid.cell_m;
  field.round_m_ = kRounding * grid.cell_m;
  return field;
}

std::size_t DistanceField::memory_bytes() const noexcept {
  return sizeof(*this) +
         sizeof(std::uint32_t) * (tree_.roots.size() + tree_.nodes.size() + tree_.words.size());
}

bool DistanceField::contains(Point<SceneFrame> place) const noexcept {
  const Vec3 p = place.v - grid_.origin_m;
  const Vec3 size = grid_.size_m();
  return p.x >= 0.0 && p.y >= 0.0 && p.z >= 0.0 && p.x <= size.x && p.y <= size.y && p.z <= size.z;
}

struct DistanceField::Descent {
  std::array<std::uint32_t, kMostLevels + 1> entries;
  std::array<int, 3> cell{};
  int last = kMostLevels + 1;
};

DistanceField::Leaf DistanceField::down_to(int x, int y, int z, Descent& path) const noexcept {
  const auto differing = static_cast<unsigned>((x ^ path.cell[0]) | (y ^ path.cell[1]) | (z ^ path.cell[2]));
  int level = std::max(path.last, static_cast<int>(std::bit_width(differing)));
  if (level > grid_.levels) {
    level = grid_.levels;
    path.entries[static_cast<std::size_t>(level)] = tree_.roots[root_index(grid_, x, y, z)];
  }
  std::uint32_t entry = path.entries[static_cast<std::size_t>(level)];
  while ((entry & FieldTree::kLeaf) == 0) {
    --level;
    const int child = (x >> level & 1) | (y >> level & 1) << 1 | (z >> level & 1) << 2;
    entry = tree_.nodes[8 * static_cast<std::size_t>(entry) + static_cast<std::size_t>(child)];
    path.entries[static_cast<std::size_t>(level)] = entry;
  }
  path.cell = {x, y, z};
  path.last = level;
  const int mask = -(1 << level);
  return {{x & mask, y & mask, z & mask}, 1 << level, entry & ~FieldTree::kLeaf};
}

DistanceField::Leaf DistanceField::leaf_of(int x, int y, int z) const noexcept {
  Descent path;
  return down_to(x, y, z, path);
}

DistanceSample DistanceField::leaf_sample(const Leaf& leaf, Vec3 cells) const noexcept {
  const double half = 0.5 * leaf.side;
  const double per_half = 1.0 / half;
  const Vec3 u{(cells.x - leaf.corner[0]) * per_half - 1.0, (cells.y - leaf.corner[1]) * per_half - 1.0,
               (cells.z - leaf.corner[2]) * per_half - 1.0};
  return leaf_at(&tree_.words[leaf.words], grid_.cell_m * cells, u, half * grid_.cell_m, round_m_);
}

FieldSample DistanceField::sample(Point<SceneFrame> place) const noexcept {
  const Vec3 wanted = cells_per_m_ * (place.v - grid_.origin_m);
  const auto within = [](double v, int n) { return v >= 0.0 && v <= n; };
  if (within(wanted.x, grid_.cells(0)) && within(wanted.y, grid_.cells(1)) &&
      within(wanted.z, grid_.cells(2))) {
    const DistanceSample s = inside(wanted);
    return {s.distance_m, {s.gradient}};
  }
  const auto at = [this](Vec3 held_m) noexcept { return inside(cells_per_m_ * held_m); };
  const DistanceSample s = outside_box(place.v - grid_.origin_m, grid_.size_m(), at);
  return {s.distance_m, {s.gradient}};
}

DistanceSample DistanceField::inside(Vec3 cells) const noexcept {
  const int nx = grid_.cells(0), ny = grid_.cells(1), nz = grid_.cells(2);
  const auto cell = [](double v, int n) { return std::min(static_cast<int>(v), n - 1); };
  Descent path;
  const Leaf home = down_to(cell(cells.x, nx), cell(cells.y, ny), cell(cells.z, nz), path);
  prefetch(&tree_.words[home.words]);
  const auto alone = [&](double v, std::size_t axis) {
    return v - 0.5 >= home.corner[axis] && v + 0.5 <= home.corner[axis] + home.side;
  };
  return alone(cells.x, 0) && alone(cells.y, 1) && alone(cells.z, 2) ? leaf_sample(home, cells)
                                                                     : mixed(cells, home, path);
}

DistanceSample DistanceField::mixed(Vec3 cells, const Leaf& home, Descent& path) const noexcept {
  const std::array<WindowSides, 3> sides{WindowSides(cells.x, grid_.cells(0)),
                                         WindowSides(cells.y, grid_.cells(1)),
                                         WindowSides(cells.z, grid_.cells(2))};
  // Most windows that leave their leaf leave it along one axis, to one other leaf.
  if (const std::size_t axis = only_axis_out_of(home, sides); axis < 3) {
    const WindowSide& side = sides[axis].out_of(home, axis);
    std::array<int, 3> cell = path.cell;
    cell[axis] = side.cell;
    const Leaf other = down_to(cell[0], cell[1], cell[2], path);
    if (sides[(axis + 1) % 3].is_in(other, (axis + 1) % 3) &&
        sides[(axis + 2) % 3].is_in(other, (axis + 2) % 3))
      return blended(leaf_sample(home, cells), leaf_sample(other, cells), side, axis, cells_per_m_);
  }
  // A leaf is a box: its share is the product of the shares of the sides that it covers along each axis.
  struct Part {
    Leaf leaf;
    double share;
    Vec3 along;
  };
  std::array<Part, 8> parts;
  std::size_t count = 0;
  for (unsigned left = 0xFFU; left != 0;) {
    const auto octant = static_cast<unsigned>(std::countr_zero(left));
    const auto cell = [&](std::size_t axis) { return sides[axis].side[octant >> axis & 1U].cell; };
    const Leaf leaf = down_to(cell(0), cell(1), cell(2), path);
    prefetch(&tree_.words[leaf.words]);
    const WindowShare x = sides[0].within(leaf, 0), y = sides[1].within(leaf, 1),
                      z = sides[2].within(leaf, 2);
    left &= ~(x.octants & y.octants & z.octants);
    const double xy = x.share * y.share;
    const double share = xy * z.share;
    const Vec3 along{x.slope * y.share * z.share, x.share * y.slope * z.share, xy * z.slope};
    // Planes do not depend on the leaf's position, so leaves with the same planes are evaluated once.
    std::size_t k = 0;
    while (k < count && !(parts[k].leaf.words == leaf.words && LeafHead{tree_.words[leaf.words]}.flat())) ++k;
    if (k == count) parts[count++] = {leaf, 0.0, {}};
    parts[k].share += share;
    parts[k].along += along;
  }
  if (count == 1) return leaf_sample(parts[0].leaf, cells);
  DistanceSample sample;
  for (std::size_t k = 0; k < count; ++k) {
    const Part& part = parts[k];
    const DistanceSample s = leaf_sample(part.leaf, cells);
    sample.distance_m += part.share * s.distance_m;
    sample.gradient += part.share * s.gradient + (s.distance_m * cells_per_m_) * part.along;
  }
  return sample;
}

}  // namespace palpable::models
