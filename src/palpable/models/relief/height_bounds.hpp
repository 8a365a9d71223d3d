// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/models/relief/relief.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace palpable::models {

/// Upper bounds over a rectangle: of the height, and of the slope |grad z|.
struct SurfaceBounds {
  float highest = 0.0F;
  float steepest = 0.0F;
};

/// Bounds of a cubic B-spline height field over rectangles, from its control values: for blocks of 4 x 4
/// pixels, and for blocks twice as wide at each further level (a max-pyramid). Immutable; any thread.
class HeightBounds {
 public:
  HeightBounds() = default;
  /// The spline's control values, at least one.
  explicit HeightBounds(const Raster<float>& control_values);

  /// The bounds over x0 <= x <= x1, y0 <= y <= y1 in pixels (sample centres at integers, any finite values);
  /// the slope in height per pixel. Reads at most four blocks. Tick
  /// path.
  SurfaceBounds over(double x0_px, double y0_px, double x1_px, double y1_px) const noexcept;

  std::size_t memory_bytes() const noexcept { return blocks_.size() * sizeof(SurfaceBounds); }

 private:
  static constexpr int kBlock_px = 4;

  struct Level {
    std::size_t begin = 0;
    int width = 0;
    int height = 0;
  };
  void add_coarser_levels(Level level);

  std::vector<SurfaceBounds> blocks_;
  std::vector<Level> levels_;
};

/// A height field with bounds over rectangles (metres), by which a law checks a long path at once, and with
/// its exact height under a path in each cell. Never allocates, locks or throws.
template <class M>
concept BoundedHeightField = CurvedHeightField<M> && requires(const M& m, double x_m, double y_m, Vec3 p) {
  { m.bounds_over(x_m, y_m, x_m, y_m) } -> std::same_as<SurfaceBounds>;
  { m.cell_walk(p, p) } -> std::same_as<CellWalk>;
  { m.path_in_cell(p, p) } -> std::same_as<CellPath>;
  requires noexcept(m.bounds_over(x_m, y_m, x_m, y_m))&& noexcept(m.cell_walk(p, p))&& noexcept(
      m.path_in_cell(p, p));
};

/// A relief with bounds of its surface, which take a sixth of its memory. Immutable; any thread.
class BoundedRelief {
 public:
  explicit BoundedRelief(std::shared_ptr<const Relief> relief)
      : relief_(std::move(relief)),
        bounds_(relief_->samples_m()),
        middle_x_px_(0.5 * (relief_->samples_m().width() - 1)),
        middle_y_px_(0.5 * (relief_->samples_m().height() - 1)),
        pixels_per_m_(1.0 / relief_->pixel_m()) {}

  HeightSample sample(double x_m, double y_m) const noexcept { return relief_->sample(x_m, y_m); }
  PairedSample paired_sample(Pair place_m) const noexcept { return relief_->paired_sample(place_m); }
  CellPath path_in_cell(Vec3 a, Vec3 b) const noexcept { return relief_->path_in_cell(a, b); }
  CellWalk cell_walk(Vec3 a, Vec3 b) const noexcept { return relief_->cell_walk(a, b); }
  [[gnu::always_inline]] void prefetch(Vec3 a, Vec3 b) const noexcept { relief_->prefetch(a, b); }
  [[gnu::always_inline]] void prefetch(double x_m, double y_m) const noexcept { relief_->prefetch(x_m, y_m); }
  double steepest_slope() const noexcept { return relief_->steepest_slope(); }
  double pixel_m() const noexcept { return relief_->pixel_m(); }
  /// The bounds over the rectangle between two opposite corners, any finite values. Tick path.
  SurfaceBounds bounds_over(double x0_m, double y0_m, double x1_m, double y1_m) const noexcept {
    const double left = middle_x_px_ + std::min(x0_m, x1_m) * pixels_per_m_;
    const double right = middle_x_px_ + std::max(x0_m, x1_m) * pixels_per_m_;
    const double top = middle_y_px_ - std::max(y0_m, y1_m) * pixels_per_m_;
    const double bottom = middle_y_px_ - std::min(y0_m, y1_m) * pixels_per_m_;
    SurfaceBounds bounds = bounds_.over(left, top, right, bottom);
    bounds.steepest *= static_cast<float>(pixels_per_m_);
    return bounds;
  }
  const Relief& relief() const noexcept { return *relief_; }
  std::size_t memory_bytes() const { return relief_->memory_bytes() + bounds_.memory_bytes(); }

 private:
  std::shared_ptr<const Relief> relief_;
  HeightBounds bounds_;
  double middle_x_px_;
  double middle_y_px_;
  double pixels_per_m_;
};

}  // namespace palpable::models
