// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/distance_field.hpp"

#include "palpable/models/field_leaf.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace palpable::models {
namespace {

constexpr int kMostLevels = 10;
constexpr std::size_t kMostRoots = std::size_t{1} << 24U;

bool grid_is_sound(const FieldGrid& grid) {
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

/// Whether the words that begin there are a leaf, all of it in place and finite.
bool leaf_is_sound(const std::vector<std::uint32_t>& words, std::size_t at) {
  if (at >= words.size()) return false;
  const LeafHead head{words[at]};
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

/// Every entry leads to a sound leaf or, deeper, to a node of its own; counts the leaves.
Result<std::size_t> checked_leaves(const FieldGrid& grid, const FieldTree& tree) {
  const Error damaged = invalid_input("holds a field whose cells are damaged");
  const std::size_t roots = static_cast<std::size_t>(grid.roots[0]) *
                            static_cast<std::size_t>(grid.roots[1]) * static_cast<std::size_t>(grid.roots[2]);
  if (tree.roots.size() != roots || tree.nodes.size() % 8 != 0) return damaged;
  const std::size_t nodes = tree.nodes.size() / 8;
  // The level of the entry that leads to a node; nodes come in an order in which parents are first.
  std::vector<std::int8_t> level(nodes, std::int8_t{-1});
  std::size_t leaves = 0;
  const auto check = [&](std::uint32_t entry, int entry_level, std::size_t after) {
    if ((entry & FieldTree::kLeaf) != 0) {
      ++leaves;
      return leaf_is_sound(tree.words, entry & ~FieldTree::kLeaf);
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

/// The way down to a finest cell: the entry at each level, as far as `last`.
struct Descent {
  std::array<std::uint32_t, kMostLevels + 1> entries;
  std::array<int, 3> cell{};
  int last = kMostLevels + 1;
};

/// The leaf that holds a finest cell, from where the last way parted from this one: above, the entries are
/// the same.
DistanceField::Leaf down_to(const FieldGrid& grid, const FieldTree& tree, int x, int y, int z,
                            Descent& way) noexcept {
  const auto differing = static_cast<unsigned>((x ^ way.cell[0]) | (y ^ way.cell[1]) | (z ^ way.cell[2]));
  int level = std::max(way.last, static_cast<int>(std::bit_width(differing)));
  if (level > grid.levels) {
    level = grid.levels;
    const auto root = static_cast<std::size_t>((z >> level) * grid.roots[1] + (y >> level)) *
                          static_cast<std::size_t>(grid.roots[0]) +
                      static_cast<std::size_t>(x >> level);
    way.entries[static_cast<std::size_t>(level)] = tree.roots[root];
  }
  std::uint32_t entry = way.entries[static_cast<std::size_t>(level)];
  while ((entry & FieldTree::kLeaf) == 0) {
    --level;
    const int child = (x >> level & 1) | (y >> level & 1) << 1 | (z >> level & 1) << 2;
    entry = tree.nodes[8 * static_cast<std::size_t>(entry) + static_cast<std::size_t>(child)];
    way.entries[static_cast<std::size_t>(level)] = entry;
  }
  way.cell = {x, y, z};
  way.last = level;
  const int mask = -(1 << level);
  return {{x & mask, y & mask, z & mask}, 1 << level, entry & ~FieldTree::kLeaf};
}

/// The share of the window on the upper side of a face that stands `beyond` finest cells above the place
/// (-0.5 ... 0.5 is under the window), and how it changes per cell.
struct Share {
  double upper = 0.0;
  double slope = 0.0;
};
Share share_above(double place_over_face) {
  const double t = 2.0 * place_over_face;
  const double rest = 1.0 - std::abs(t);
  return {t < 0.0 ? 0.5 * rest * rest : 1.0 - 0.5 * rest * rest, 2.0 * rest};
}

}  // namespace

Result<DistanceField> DistanceField::from_tree(const FieldGrid& grid, FieldTree tree,
                                               const FieldErrors& errors) {
  if (!grid_is_sound(grid)) return invalid_input("holds a field whose grid makes no sense");
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

bool DistanceField::contains(Vec3 place_m) const noexcept {
  const Vec3 p = place_m - grid_.origin_m;
  const Vec3 size = grid_.size_m();
  return p.x >= 0.0 && p.y >= 0.0 && p.z >= 0.0 && p.x <= size.x && p.y <= size.y && p.z <= size.z;
}

DistanceField::Leaf DistanceField::leaf_of(int x, int y, int z) const noexcept {
  Descent way;
  return down_to(grid_, tree_, x, y, z, way);
}

FieldSample DistanceField::leaf_sample(const Leaf& leaf, Vec3 cells) const noexcept {
  const double half = 0.5 * leaf.side;
  const double per_half = 1.0 / half;
  const Vec3 u{(cells.x - leaf.corner[0]) * per_half - 1.0, (cells.y - leaf.corner[1]) * per_half - 1.0,
               (cells.z - leaf.corner[2]) * per_half - 1.0};
  return leaf_at(&tree_.words[leaf.words], grid_.cell_m * cells, u, half * grid_.cell_m, round_m_);
}

FieldSample DistanceField::sample(Vec3 place_m) const noexcept {
  const Vec3 wanted = cells_per_m_ * (place_m - grid_.origin_m);
  const auto held = [](double v, int n) { return v > 0.0 ? (v < n ? v : static_cast<double>(n)) : 0.0; };
  const int nx = grid_.cells(0), ny = grid_.cells(1), nz = grid_.cells(2);
  const Vec3 cells{held(wanted.x, nx), held(wanted.y, ny), held(wanted.z, nz)};
  const auto cell = [](double v, int n) { return std::min(static_cast<int>(v), n - 1); };
  const Leaf home = leaf_of(cell(cells.x, nx), cell(cells.y, ny), cell(cells.z, nz));
  const auto inside = [&](double v, std::size_t axis) {
    return v - 0.5 >= home.corner[axis] && v + 0.5 <= home.corner[axis] + home.side;
  };
  FieldSample sample = inside(cells.x, 0) && inside(cells.y, 1) && inside(cells.z, 2)
                           ? leaf_sample(home, cells)
                           : mixed(cells);
  if (wanted != cells) {
    const Vec3 way = grid_.cell_m * (wanted - cells);
    const double length = norm(way);
    sample.distance_m += length;
    sample.gradient = unit(way);
  }
  return sample;
}

FieldSample DistanceField::mixed(Vec3 cells) const noexcept {
  // On each axis one face of the finest grid is nearest: the window reaches over it or ends at the next two.
  const std::array<double, 3> place{cells.x, cells.y, cells.z};
  std::array<int, 3> face{};
  std::array<Share, 3> share{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    face[axis] = static_cast<int>(place[axis] + 0.5);
    share[axis] = share_above(place[axis] - face[axis]);
  }
  struct Part {
    Leaf leaf;
    double share = 0.0;
    Vec3 slope;
  };
  std::array<Part, 8> parts;
  std::size_t count = 0;
  Descent way;
  const auto holds = [](const Leaf& leaf, const std::array<int, 3>& c) {
    return c[0] >= leaf.corner[0] && c[0] < leaf.corner[0] + leaf.side && c[1] >= leaf.corner[1] &&
           c[1] < leaf.corner[1] + leaf.side && c[2] >= leaf.corner[2] && c[2] < leaf.corner[2] + leaf.side;
  };
  for (unsigned octant = 0; octant < 8; ++octant) {
    std::array<int, 3> c{};
    std::array<double, 3> w{};
    std::array<double, 3> dw{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool upper = (octant >> axis & 1U) != 0;
      c[axis] = std::clamp(face[axis] - (upper ? 0 : 1), 0, grid_.cells(axis) - 1);
      w[axis] = upper ? share[axis].upper : 1.0 - share[axis].upper;
      dw[axis] = upper ? share[axis].slope : -share[axis].slope;
    }
    std::size_t k = 0;
    while (k < count && !holds(parts[k].leaf, c)) ++k;
    if (k == count) {
      // Planes do not depend on their leaf: along an edge, all leaves round it say the same.
      const Leaf leaf = down_to(grid_, tree_, c[0], c[1], c[2], way);
      const bool flat = LeafHead{tree_.words[leaf.words]}.flat();
      for (k = 0; k < count && !(flat && parts[k].leaf.words == leaf.words);) ++k;
      if (k == count) parts[count++].leaf = leaf;
    }
    parts[k].share += w[0] * w[1] * w[2];
    parts[k].slope += Vec3{dw[0] * w[1] * w[2], w[0] * dw[1] * w[2], w[0] * w[1] * dw[2]};
  }
  if (count == 1) return leaf_sample(parts[0].leaf, cells);
  FieldSample sample;
  for (std::size_t k = 0; k < count; ++k) {
    const FieldSample s = leaf_sample(parts[k].leaf, cells);
    sample.distance_m += parts[k].share * s.distance_m;
    sample.gradient += parts[k].share * s.gradient + (s.distance_m * cells_per_m_) * parts[k].slope;
  }
  return sample;
}

}  // namespace palpable::models
