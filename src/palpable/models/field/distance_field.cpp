// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/distance_field.hpp"

#include "palpable/models/field/field_leaf.hpp"
#include "palpable/models/field/outside_box.hpp"
#include "palpable/models/field/window_weights.hpp"

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

/// Prefetches a leaf's words; a compact leaf may span two cache lines.
void prefetch(const std::uint32_t* words) {
  __builtin_prefetch(words);
  __builtin_prefetch(words + LeafHead::kCompactWords - 1);
}

/// Whether one of eight numbers is a certain one: without a branch for each.
bool is_any_of(const std::array<std::uint32_t, 8>& numbers, std::uint32_t wanted) {
  bool is_any = false;
  for (const std::uint32_t number : numbers) is_any |= number == wanted;
  return is_any;
}

/// 2 / 2^level: halves of a leaf's side in a finest cell.
constexpr auto kHalvesPerCell = [] {
  std::array<double, kMostLevels + 1> halves{};
  for (std::size_t level = 0; level < halves.size(); ++level) halves[level] = 2.0 / (1U << level);
  return halves;
}();

std::size_t root_index(const FieldGrid& grid, int x, int y, int z) {
  const int level = grid.levels;
  return static_cast<std::size_t>((z >> level) * grid.roots[1] + (y >> level)) *
             static_cast<std::size_t>(grid.roots[0]) +
         static_cast<std::size_t>(x >> level);
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

inline std::uint32_t DistanceField::down_to(int x, int y, int z, Descent& path) const noexcept {
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
  return entry & ~FieldTree::kLeaf;
}

DistanceField::Leaf DistanceField::leaf_of(int x, int y, int z) const noexcept {
  Descent path;
  const std::uint32_t words = down_to(x, y, z, path);
  const int mask = -(1 << path.last);
  return {{x & mask, y & mask, z & mask}, 1 << path.last, words};
}

FieldSample DistanceField::sample(Point<SceneFrame> place) const noexcept {
  FieldWindow window;
  return sample(place, window);
}

FieldSample DistanceField::sample(Point<SceneFrame> place, FieldWindow& window) const noexcept {
  const Vec3 wanted = cells_per_m_ * (place.v - grid_.origin_m);
  if (!window.is_of(wanted)) {
    const auto within = [](double v, int n) { return v >= 0.0 && v <= n; };
    if (!within(wanted.x, grid_.cells(0)) || !within(wanted.y, grid_.cells(1)) ||
        !within(wanted.z, grid_.cells(2)))
      return sample_outside(place, window);
    find_leaves(wanted, window);
  }
  const DistanceSample s = averaged(wanted, window);
  return {s.distance_m, {s.gradient}};
}

FieldSample DistanceField::sample_outside(Point<SceneFrame> place, FieldWindow& window) const noexcept {
  const auto at = [&](Vec3 held_m) noexcept {
    const Vec3 cells = cells_per_m_ * held_m;
    find_leaves(cells, window);
    return averaged(cells, window);
  };
  const DistanceSample s = outside_box(place.v - grid_.origin_m, grid_.size_m(), at);
  return {s.distance_m, {s.gradient}};
}

void DistanceField::find_leaves(Vec3 cells, FieldWindow& window) const noexcept {
  const auto nearest = [](double v) { return static_cast<std::int32_t>(v + 0.5); };
  window.corner = {nearest(cells.x), nearest(cells.y), nearest(cells.z)};
  // The finest cells below and above the corner, and the bits in which they differ.
  std::array<std::array<int, 2>, 3> sides;
  std::array<int, 3> differing;
  bool is_inner = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int corner = window.corner[axis], cells_along = grid_.cells(axis);
    sides[axis] = {std::max(corner - 1, 0), std::min(corner, cells_along - 1)};
    differing[axis] = sides[axis][0] ^ sides[axis][1];
    is_inner = is_inner && corner > 0 && corner < cells_along;
  }
  window.is_inner = is_inner;
  window.words.fill(FieldTree::kLeaf);
  Descent path;
  std::size_t count = 0, different = 0;
  for (unsigned left = 0xFFU; left != 0;) {
    const auto octant = static_cast<unsigned>(std::countr_zero(left));
    const unsigned x = octant & 1U, y = octant >> 1U & 1U, z = octant >> 2U;
    const std::uint32_t words = down_to(sides[0][x], sides[1][y], sides[2][z], path);
    prefetch(&tree_.words[words]);
    const int level = path.last;
    // The octants on its side along each axis, and those on the other side where it holds both; without a
    // branch, which could not be predicted.
    const auto covered = [&](std::size_t axis, unsigned side, unsigned below) {
      const unsigned both = (differing[axis] >> level) == 0 ? 0xFFU : 0U;
      return (below ^ (0U - side)) | both;
    };
    const unsigned octants = covered(0, x, 0x55U) & covered(1, y, 0x33U) & covered(2, z, 0x0FU) & 0xFFU;
    left &= ~octants;
    // Planes do not depend on the leaf's position, so leaves with the same planes are evaluated once.
    std::size_t same = count;
    if (is_any_of(window.words, words)) [[unlikely]]
      if (LeafHead{tree_.words[words]}.flat())
        same = static_cast<std::size_t>(std::find(window.words.begin(), window.words.end(), words) -
                                        window.words.begin());
    different += same == count ? 1U : 0U;
    window.words[count] = words;
    window.octants[count] = static_cast<std::uint8_t>(octants);
    window.level[count] = static_cast<std::uint8_t>(level);
    window.same[count] = static_cast<std::uint8_t>(same);
    ++count;
  }
  window.count = static_cast<std::uint8_t>(count);
  window.different = static_cast<std::uint8_t>(different);
}

inline DistanceSample DistanceField::leaf_sample(const FieldWindow& window, std::size_t k,
                                                 Vec3 cells) const noexcept {
  const unsigned level = window.level[k];
  const int side = 1 << level;
  const double per_half = kHalvesPerCell[level];
  const WindowSides& sides = kWindowSides[window.octants[k]];
  const auto u = [&](double place, std::size_t axis) {
    return (place - (std::max(window.corner[axis] - sides.below(axis), 0) & -side)) * per_half - 1.0;
  };
  return leaf_at(&tree_.words[window.words[k]], grid_.cell_m * cells,
                 {u(cells.x, 0), u(cells.y, 1), u(cells.z, 2)}, 0.5 * side * grid_.cell_m, round_m_);
}

inline DistanceSample DistanceField::average_of_two(Vec3 cells, const FieldWindow& window,
                                                    const std::array<double, 3>& over_corner) const noexcept {
  // By arithmetic, as nothing here can be predicted: the axis is 0, 1 or 2 with the same probability.
  const unsigned octants = window.octants[0];
  const bool is_y = octants == 0x33U, is_z = octants == 0x0FU;
  const std::size_t axis = std::size_t{is_y} + 2U * std::size_t{is_z};
  const Vec3 unit_axis{static_cast<double>(!is_y && !is_z), static_cast<double>(is_y),
                       static_cast<double>(is_z)};
  const WindowShares shares(over_corner[axis]);
  // The leaf that contains the place comes first.
  const std::size_t home{over_corner[axis] >= 0.0};
  const std::size_t side = 2 - home;
  const DistanceSample a = leaf_sample(window, home, cells), b = leaf_sample(window, 1 - home, cells);
  const double difference_m = b.distance_m - a.distance_m;
  const double along = shares.slope[side] * difference_m * cells_per_m_;
  return {a.distance_m + shares.share[side] * difference_m,
          a.gradient + shares.share[side] * (b.gradient - a.gradient) + along * unit_axis};
}

DistanceSample DistanceField::averaged(Vec3 cells, const FieldWindow& window) const noexcept {
  if (window.different == 1) return leaf_sample(window, 0, cells);
  const std::array<double, 3> over_corner{cells.x - window.corner[0], cells.y - window.corner[1],
                                          cells.z - window.corner[2]};
  // Most windows that leave their leaf leave it along one axis, to one other leaf.
  if (window.count == 2) return average_of_two(cells, window, over_corner);
  const std::array<WindowShares, 3> shares{WindowShares(over_corner[0]), WindowShares(over_corner[1]),
                                           WindowShares(over_corner[2])};
  DistanceSample sample;
  const auto add = [&](std::size_t k, const WindowWeight& weight) {
    const DistanceSample s = leaf_sample(window, k, cells);
    sample.distance_m += weight.share * s.distance_m;
    sample.gradient += weight.share * s.gradient + (s.distance_m * cells_per_m_) * weight.along;
  };
  if (window.different == window.count) {
    for (std::size_t k = 0; k < window.count; ++k) add(k, weight_of(kWindowSides[window.octants[k]], shares));
    return sample;
  }
  std::array<WindowWeight, 8> weights;
  for (std::size_t k = 0; k < window.count; ++k) {
    const WindowWeight weight = weight_of(kWindowSides[window.octants[k]], shares);
    if (window.same[k] == k) {
      weights[k] = weight;
    } else {
      weights[window.same[k]].share += weight.share;
      weights[window.same[k]].along += weight.along;
    }
  }
  for (std::size_t k = 0; k < window.count; ++k)
    if (window.same[k] == k) add(k, weights[k]);
  return sample;
}

}  // namespace palpable::models
