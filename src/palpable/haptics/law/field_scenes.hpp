// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Solids as adaptive and as dense fields, for tests of touch on them.

#include "palpable/models/field/field.hpp"
#include "palpable/models/field/field_leaf.hpp"
#include "palpable/models/scene/scene.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace palpable::haptics {

struct NamedScene {
  std::string name;
  models::Scene scene;
};

inline constexpr double kMargin_m = 2e-3;

/// A box around the origin as an adaptive field of eight leaves, each a corner of three exact planes, whose
/// finest cells are `size / 256` long.
inline NamedScene box_of_leaves(std::string name, Vec3 half_m) {
  constexpr int kLevels = 7;
  models::FieldGrid grid;
  const double side_m = std::max({half_m.x, half_m.y, half_m.z}) + kMargin_m;
  grid.levels = kLevels;
  grid.cell_m = side_m / (1 << kLevels);
  grid.roots = {2, 2, 2};
  grid.origin_m = {-side_m, -side_m, -side_m};
  models::FieldTree tree;
  for (unsigned octant = 0; octant < 8; ++octant) {
    tree.roots.push_back(models::FieldTree::kLeaf | static_cast<std::uint32_t>(tree.words.size()));
    // Three planes that meet twice, convexly.
    const models::LeafHead head{2};
    std::vector<std::uint32_t> words(head.words(), 0U);
    words[0] = head.bits;
    const std::array<double, 3> half{half_m.x, half_m.y, half_m.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::uint32_t* plane = &words[5 + models::LeafHead::kPlaneWords * axis];
      const double outwards = (octant >> axis & 1U) != 0 ? 1.0 : -1.0;
      plane[axis] = std::bit_cast<std::uint32_t>(static_cast<float>(outwards));
      plane[3] = std::bit_cast<std::uint32_t>(static_cast<float>(-outwards * side_m - half[axis]));
    }
    models::set_half_angles(words.data());
    tree.words.insert(tree.words.end(), words.begin(), words.end());
  }
  auto distance = models::DistanceField::from_tree(grid, std::move(tree), {});
  models::Scene scene;
  scene.model =
      std::make_shared<const models::Field>(*models::field_of(*std::move(distance), -1.0 * half_m, half_m));
  return {std::move(name), std::move(scene)};
}

/// Values with the direction to the surface beside each, as the paper's representation of a field stores it.
inline std::vector<float> with_directions(const models::Lattice& lattice,
                                          const std::vector<float>& distances) {
  std::vector<float> values;
  const auto slope = [&](std::array<int, 3> at, std::size_t axis) {
    std::array<int, 3> low = at, high = at;
    low[axis] = std::max(at[axis] - 1, 0);
    high[axis] = std::min(at[axis] + 1, lattice.counts[axis] - 1);
    const auto distance = [&](std::array<int, 3> p) { return distances[lattice.index(p[0], p[1], p[2])]; };
    return 1.0 * (distance(high) - distance(low)) / (high[axis] - low[axis]);
  };
  for (int z = 0; z < lattice.counts[2]; ++z)
    for (int y = 0; y < lattice.counts[1]; ++y)
      for (int x = 0; x < lattice.counts[0]; ++x) {
        const std::array<int, 3> at{x, y, z};
        const Vec3 direction = unit(Vec3{slope(at, 0), slope(at, 1), slope(at, 2)});
        values.push_back(distances[lattice.index(x, y, z)]);
        for (const double along : {direction.x, direction.y, direction.z})
          values.push_back(static_cast<float>(along));
      }
  return values;
}

/// A solid as a dense field.
inline NamedScene on_lattice(std::string name, const std::function<double(Vec3)>& distance_to, Vec3 half_m,
                             double spacing_m,
                             models::DenseContent content = models::DenseContent::distance) {
  models::Lattice lattice;
  const Vec3 around = half_m + kMargin_m * Vec3{1.0, 1.0, 1.0};
  lattice.origin_m = -1.0 * around;
  lattice.spacing_m = spacing_m;
  const auto count = [&](double extent_m) {
    return static_cast<int>(std::ceil(2.0 * extent_m / spacing_m)) + 1;
  };
  lattice.counts = {count(around.x), count(around.y), count(around.z)};
  std::vector<float> values;
  for (int z = 0; z < lattice.counts[2]; ++z)
    for (int y = 0; y < lattice.counts[1]; ++y)
      for (int x = 0; x < lattice.counts[0]; ++x)
        values.push_back(static_cast<float>(distance_to(lattice.place_m(x, y, z))));
  if (content == models::DenseContent::distance_and_force) values = with_directions(lattice, values);
  auto dense = models::DenseField::from(lattice, content, std::move(values), {});
  models::Scene scene;
  scene.model = std::make_shared<const models::FieldOnLattice>(
      *models::field_of(*std::move(dense), -1.0 * half_m, half_m));
  return {std::move(name), std::move(scene)};
}

}  // namespace palpable::haptics
