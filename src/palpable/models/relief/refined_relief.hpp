// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/relief/finer_cells.hpp"
#include "palpable/models/relief/relief.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <utility>

namespace palpable::models {

/// A relief, of which some cells may have a finer spline: the surface of a ball that rolls over a relief has
/// creases that a spline with the relief's pixels cannot follow. Height, slope and curvature are continuous.
/// A cheap value: it shares what it consists of. Immutable; any thread.
class RefinedRelief {
 public:
  /// A relief as it is; not null.
  // NOLINTNEXTLINE(google-explicit-constructor): every relief is one.
  RefinedRelief(std::shared_ptr<const Relief> relief) : RefinedRelief(std::move(relief), nullptr) {}
  /// `cells`: of a relief with as many samples; null: none.
  RefinedRelief(std::shared_ptr<const Relief> relief, std::shared_ptr<const FinerCells> cells);

  /// Height and exact gradient at (x_m, y_m), any finite value. Tick path.
  HeightSample sample(double x_m, double y_m) const noexcept {
    std::array<float, 16> copy;
    const Place at = place_at(x_m, y_m, copy);
    return height_sample_of(SplineBlock(at.place).evaluate(), at.per_m);
  }
  /// The same with the exact second derivatives, at little more cost. Tick path.
  CurvedSample curved_sample(double x_m, double y_m) const noexcept {
    std::array<float, 16> copy;
    const Place at = place_at(x_m, y_m, copy);
    return curved_sample_of(SplineBlock(at.place).evaluate_with_curvature(), at.per_m);
  }
  /// Prefetches the values for a later query at this position, without waiting. Tick path.
  [[gnu::always_inline]] void prefetch(double x_m, double y_m) const noexcept;

  /// An upper bound of the slope |grad z|.
  double steepest_slope() const noexcept { return steepest_slope_; }
  /// The pixel of the relief, whatever the finer cells: no ridge is narrower, since these follow the surface
  /// of a ball, whose ridges are round. A crease between two walls may be as sharp as the finest cell.
  double pixel_m() const noexcept { return relief_->pixel_m(); }

  /// The relief without its finer cells; and these, or null.
  const std::shared_ptr<const Relief>& relief() const noexcept { return relief_; }
  const std::shared_ptr<const FinerCells>& cells() const noexcept { return cells_; }
  std::size_t memory_bytes() const;

 private:
  struct Place {
    SplinePlace place;
    double per_m;
  };
  double x_px(double x_m) const noexcept { return middle_x_px_ + x_m * pixels_per_m_; }
  double y_px(double y_m) const noexcept { return middle_y_px_ - y_m * pixels_per_m_; }
  bool is_inside(double x_px, double y_px) const noexcept {
    return x_px >= 1.0 && x_px < inside_x_px_ && y_px >= 1.0 && y_px < inside_y_px_;
  }
  Place place_at(double x_m, double y_m, std::array<float, 16>& copy) const noexcept {
    if (cells_ != nullptr) {
      const double x = x_px(x_m);
      const double y = y_px(y_m);
      if (is_inside(x, y)) {
        const FinerCells::Found found = cells_->find(x, y);
        if (found.parts > 0) return {found.place, pixels_per_m_ * found.parts};
      }
    }
    return {relief_->place_at(x_m, y_m, copy), pixels_per_m_};
  }

  std::shared_ptr<const Relief> relief_;
  std::shared_ptr<const FinerCells> cells_;
  double pixels_per_m_;
  double middle_x_px_;
  double middle_y_px_;
  double inside_x_px_;
  double inside_y_px_;
  double steepest_slope_;
};

// Forced inline: g++ removes calls of a function that only prefetches, since it has no visible effect.
[[gnu::always_inline]] inline void RefinedRelief::prefetch(double x_m, double y_m) const noexcept {
  if (cells_ != nullptr && is_inside(x_px(x_m), y_px(y_m))) {
    const FinerCells::Found found = cells_->find(x_px(x_m), y_px(y_m));
    if (found.parts > 0) {
      for (std::size_t k = 0; k < 4; ++k) __builtin_prefetch(found.place.first + k * found.place.stride);
      return;
    }
  }
  relief_->prefetch(x_m, y_m);
}

}  // namespace palpable::models
