// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/surface_cells.hpp"

#include "palpable/describe/numbers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

namespace palpable::page {
namespace {

using Leaf = models::DistanceField::Leaf;

constexpr int kLongestSide = 768;
/// Narrower cells are not outlined, in pixels of the picture.
constexpr double kLeastOutlined = 4.0;

Raster<Leaf> leaves_of(const models::Field& field) {
  const models::Relief& top = *field.from_above;
  const models::FieldGrid& grid = field.distance.grid();
  const double pixel_m = std::max(top.size_x_m(), top.size_y_m()) / kLongestSide;
  const auto count = [&](double length_m) { return std::max(2, static_cast<int>(length_m / pixel_m + 0.5)); };
  const auto cell = [&](double at_m, double origin_m, std::size_t axis) {
    return std::clamp(static_cast<int>((at_m - origin_m) / grid.cell_m), 0, grid.cells(axis) - 1);
  };
  Raster<Leaf> leaves(count(top.size_x_m()), count(top.size_y_m()));
  for (int j = 0; j < leaves.height(); ++j) {
    const double y_m = (0.5 - (j + 0.5) / leaves.height()) * top.size_y_m();
    for (int i = 0; i < leaves.width(); ++i) {
      const double x_m = ((i + 0.5) / leaves.width() - 0.5) * top.size_x_m();
      leaves(i, j) = field.distance.leaf_of(cell(x_m, grid.origin_m.x, 0), cell(y_m, grid.origin_m.y, 1),
                                            cell(top.sample(x_m, y_m).z_m, grid.origin_m.z, 2));
    }
  }
  return leaves;
}

/// From sand (finest cells) to deep blue (root cells).
Rgb8 colour_of(const Leaf& leaf, int levels) {
  const int level = static_cast<int>(std::bit_width(static_cast<unsigned>(leaf.side))) - 1;
  const double t = static_cast<double>(level) / std::max(levels, 1);
  const auto mix = [&](int from, int to) {
    return static_cast<std::uint8_t>(std::lround(from + t * (to - from)));
  };
  return {mix(246, 40), mix(232, 90), mix(200, 150)};
}

Raster<Rgb8> picture_of(const Raster<Leaf>& leaves, int levels, double pixels_a_cell) {
  constexpr Rgb8 kLine{30, 30, 30};
  const auto outlined = [&](const Leaf& leaf) { return leaf.side * pixels_a_cell >= kLeastOutlined; };
  Raster<Rgb8> picture(leaves.width(), leaves.height());
  for (int j = 0; j < leaves.height(); ++j)
    for (int i = 0; i < leaves.width(); ++i) {
      const Leaf& here = leaves(i, j);
      const auto parted = [&](const Leaf& next) {
        return next.corner != here.corner && (outlined(here) || outlined(next));
      };
      const bool line = (i + 1 < leaves.width() && parted(leaves(i + 1, j))) ||
                        (j + 1 < leaves.height() && parted(leaves(i, j + 1)));
      picture(i, j) = line ? kLine : colour_of(here, levels);
    }
  return picture;
}

std::string words_of(const Raster<Leaf>& leaves, const models::DistanceField& field) {
  const auto [finest, coarsest] =
      std::minmax_element(leaves.values().begin(), leaves.values().end(),
                          [](const Leaf& a, const Leaf& b) { return a.side < b.side; });
  const double cell_mm = 1e3 * field.cell_m();
  return fmt::format(
      "The field has {} cells; at the surface they are {} to {} mm wide. Finer cells are lighter.",
      field.leaves(), figure(finest->side * cell_mm), figure(coarsest->side * cell_mm));
}

}  // namespace

std::optional<SurfaceCells> surface_cells(const models::Scene& scene) {
  const auto* const field = std::get_if<std::shared_ptr<const models::Field>>(&scene.model);
  if (field == nullptr) return std::nullopt;
  const models::DistanceField& distance = (*field)->distance;
  const Raster<Leaf> leaves = leaves_of(**field);
  const double pixels_a_cell = distance.cell_m() * leaves.width() / (*field)->from_above->size_x_m();
  return SurfaceCells{picture_of(leaves, distance.grid().levels, pixels_a_cell), words_of(leaves, distance)};
}

}  // namespace palpable::page
