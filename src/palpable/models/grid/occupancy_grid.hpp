// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::models {

/// Which points of a lattice lie inside a solid, x fastest, then y, then z: one byte each, 0 or 1.
struct Occupancy {
  std::array<int, 3> counts{};
  /// Position of the point (0, 0, 0).
  Vec3 origin_m;
  double spacing_m = 0.0;
  std::vector<std::uint8_t> occupied;

  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(counts[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(counts[0]) +
           static_cast<std::size_t>(x);
  }
  std::size_t points() const { return occupied.size(); }
};

/// Most points of one grid; building takes 24 bytes per point.
constexpr std::size_t kMaxGridPoints = std::size_t{1} << 25U;

/// Depth below the surface, and outward normal.
struct GridSample {
  /// Above 0 inside; at least minus half a spacing outside.
  double depth_m = 0.0;
  /// Outward unit normal; 0 if no occupied point is near.
  Vector<SceneFrame> normal;
};

/// The model of Park & Howard 2012, section 5: a sparse lattice of occupied points filled from a depth map.
/// Near the surface the normal comes from a table over the occupancy of eight neighbours, deep inside from
/// the nearest free point. Depth and normal are stored at lattice points and interpolated. Blocks of 8 x 8 x
/// 8 points are stored only near occupied points. It is coarser than a distance field and not conservative:
/// its normal is not the gradient of its depth. Immutable; any thread.
class OccupancyGrid {
 public:
  /// Points beyond the lattice count as free. Errors: invalid_input for counts that do not fit `occupied` or
  /// are below 2, more than kMaxGridPoints, a spacing not in 1e-6 ... 1 m, or no point occupied; interrupted.
  static Result<OccupancyGrid> from(const Occupancy& occupancy, const Work& work);

  /// At any finite position. Tick path.
  GridSample sample(Point<SceneFrame> place) const noexcept;
  bool occupied(int x, int y, int z) const noexcept;
  /// The original lattice.
  Occupancy occupancy() const;

  std::array<int, 3> counts() const noexcept { return counts_; }
  Vec3 origin_m() const noexcept { return origin_m_; }
  double spacing_m() const noexcept { return spacing_m_; }
  Vec3 size_m() const noexcept {
    return {spacing_m_ * (counts_[0] - 1), spacing_m_ * (counts_[1] - 1), spacing_m_ * (counts_[2] - 1)};
  }
  std::size_t occupied_points() const noexcept { return occupied_points_; }
  std::size_t memory_bytes() const noexcept;
  /// Reads every page once, so that the first touch does not wait for them.
  void touch_pages() const noexcept;

 private:
  OccupancyGrid() = default;
  struct Cell {
    std::int16_t depth;                 // in spacings / 128
    std::array<std::int8_t, 3> normal;  // in 1 / 127
    std::uint8_t occupied;
  };
  static constexpr int kBlock = 8;
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  const Cell* cell(int x, int y, int z) const noexcept;

  std::array<int, 3> counts_{};
  std::array<int, 3> blocks_{};
  Vec3 origin_m_;
  double spacing_m_ = 0.0;
  std::size_t occupied_points_ = 0;
  std::vector<std::uint32_t> block_of_;
  std::vector<std::array<Cell, 512>> cells_;
};

/// The outward unit normal of the surface between eight neighbours; bit x + 2 y + 4 z of `mask` is set if
/// that corner is occupied. 0 for symmetric patterns, such as none or all.
Vec3 neighbour_normal(unsigned mask) noexcept;

}  // namespace palpable::models
