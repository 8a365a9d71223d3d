// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/models/field/distance_surface.hpp"
#include "palpable/models/relief/relief.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace palpable::models {

/// The depth of a point below a relief: its distance to the nearest point of the surface. It equals the
/// radius of the ball whose erosion of the relief passes through the point. The relief and its erosions by
/// balls of 1, 2, 4, ... 32 pixels are stored. Between two of them the depth is interpolated linearly in the
/// height, so it is continuous everywhere with an exact gradient, whatever the error of the erosions. On a
/// constant slope it is the exact distance. Deeper than 32 pixels, and above the surface, it continues
/// linearly in the height at the rate of the steepest slope, which gives a lower bound of the distance.
/// Immutable; any thread.
class ReliefDepth {
 public:
  /// Takes six times the memory of the relief. `relief` must not be null.
  static Result<ReliefDepth> under(std::shared_ptr<const Relief> relief, const Work& work);

  /// Minus the depth, and its gradient, at any finite position. Tick path.
  FieldSample sample(Point<SceneFrame> place) const noexcept;

  double cell_m() const noexcept { return relief_->pixel_m(); }
  /// The greatest depth at which the value is a distance.
  double deepest_m() const noexcept { return erosions_.back().depth_m; }
  std::size_t memory_bytes() const;
  /// Calls visit(surface) with the relief and each of its erosions.
  template <class Visit>
  void each_surface(const Visit& visit) const {
    visit(*relief_);
    for (const Erosion& erosion : erosions_) visit(erosion.surface);
  }

 private:
  struct Erosion {
    Relief surface;
    double depth_m;
  };
  ReliefDepth() = default;

  std::shared_ptr<const Relief> relief_;
  std::vector<Erosion> erosions_;
  /// Ratio of distance to height on the steepest slope.
  double steepest_rate_ = 1.0;
};

}  // namespace palpable::models
