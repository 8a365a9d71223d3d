// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/refined_relief.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace palpable::models {
namespace {

/// The weights of four control values in a control value of the subdivided spline, at `u` in the cell (0 ...
/// 1, and beyond). The blossom of a cubic p at three consecutive knots u - h, u, u + h is p - h^2 / 6 p''.
std::array<double, 4> subdivision_weights(double u, double h) {
  const double less = h * h / 6.0;
  const double u2 = u * u;
  const double u3 = u2 * u;
  return {(1.0 - 3.0 * u + 3.0 * u2 - u3) / 6.0 - less * (1.0 - u),
          (4.0 - 6.0 * u2 + 3.0 * u3) / 6.0 - less * (3.0 * u - 2.0),
          (1.0 + 3.0 * u + 3.0 * u2 - 3.0 * u3) / 6.0 - less * (1.0 - 3.0 * u), u3 / 6.0 - less * u};
}

/// Bounds of the surface of one refined cell; the slope in height per pixel of the relief.
CellBounds bounds_of_cell(const ReliefCells& cells, std::size_t k) {
  const int side = cells.per_pixel + 3;
  const auto values = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  const float* const at = cells.values.data() + k * values;
  float highest = *std::max_element(at, at + values);
  float across = 0.0F;
  float down = 0.0F;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const float* const here = at + j * side + i;
      if (i + 1 < side) across = std::max(across, std::abs(here[1] - here[0]));
      if (j + 1 < side) down = std::max(down, std::abs(here[side] - here[0]));
    }
  return {cells.cells[k].x,
          cells.cells[k].y,
          {highest, static_cast<float>(cells.per_pixel) * std::hypot(across, down)}};
}

std::vector<CellBounds> bounds_of_cells(const ReliefCells& cells) {
  std::vector<CellBounds> bounds;
  bounds.reserve(cells.cells.size());
  for (std::size_t k = 0; k < cells.cells.size(); ++k) bounds.push_back(bounds_of_cell(cells, k));
  return bounds;
}

}  // namespace

void subdivide_cell(const Relief& relief, ReliefCells::Cell cell, int per_pixel, float* values) {
  const int side = per_pixel + 3;
  const double h = 1.0 / per_pixel;
  const double base = relief.samples_m()(cell.x, cell.y);
  for (int j = 0; j < side; ++j) {
    const std::array<double, 4> down = subdivision_weights((j - 1) * h, h);
    std::array<double, 4> row{};
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b)
        row[a] +=
            down[b] *
            (double{relief.samples_m()(cell.x - 1 + static_cast<int>(a), cell.y - 1 + static_cast<int>(b))} -
             base);
    for (int i = 0; i < side; ++i) {
      const std::array<double, 4> across = subdivision_weights((i - 1) * h, h);
      values[j * side + i] = static_cast<float>(base + (across[0] * row[0] + across[1] * row[1]) +
                                                (across[2] * row[2] + across[3] * row[3]));
    }
  }
}

RefinedRelief::RefinedRelief(const std::shared_ptr<const Relief>& relief, ReliefCells cells)
    : cells_(std::move(cells)),
      bounded_(relief, bounds_of_cells(cells_)),
      width_(relief->samples_m().width() - 2),
      height_(relief->samples_m().height() - 2),
      steepest_slope_(relief->steepest_slope()),
      middle_x_px_(0.5 * (relief->samples_m().width() - 1)),
      middle_y_px_(0.5 * (relief->samples_m().height() - 1)),
      pixels_per_m_(1.0 / relief->pixel_m()),
      fine_per_m_(cells_.per_pixel / relief->pixel_m()) {
  const auto side = static_cast<std::size_t>(cells_.per_pixel + 3);
  PALPABLE_CHECK(cells_.values.size() == cells_.cells.size() * side * side);
  if (cells_.cells.empty()) width_ = 0;  // no cell is looked for
  bits_.resize((static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) + 63) / 64);
  std::size_t next = 0;
  for (std::size_t k = 0; k < cells_.cells.size(); ++k) {
    const ReliefCells::Cell cell = cells_.cells[k];
    PALPABLE_CHECK(cell.x >= 1 && cell.y >= 1 && cell.x < width_ && cell.y < height_);
    const std::size_t at = static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width_) +
                           static_cast<std::size_t>(cell.x);
    PALPABLE_CHECK(at >= next);
    next = at + 1;
    bits_[at / 64].refined |= std::uint64_t{1} << (at % 64);
    steepest_slope_ =
        std::max(steepest_slope_, double{bounds_of_cell(cells_, k).bounds.steepest} * pixels_per_m_);
  }
  std::size_t before = 0;
  for (CellBits& bits : bits_) {
    bits.before = static_cast<std::uint32_t>(before);
    before += set_bits(bits.refined);
  }
}

std::size_t RefinedRelief::memory_bytes() const {
  return bounded_.memory_bytes() + bits_.size() * sizeof(CellBits) +
         cells_.cells.size() * sizeof(ReliefCells::Cell) + cells_.values.size() * sizeof(float);
}

}  // namespace palpable::models
