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

/// How deep a place lies under a relief: the distance to the nearest place of its surface, which is how large
/// the ball is that erodes the relief down to there. Kept as the relief and its erosions by balls of 1, 2, 4
/// … 32 pixels; between two of them the depth follows the height, so that it is continuous everywhere and its
/// gradient is exact, whatever the error of the erosions. On even slopes it is the distance itself. Deeper
/// than 32 pixels, and above the surface, it goes on with the height at the rate of the steepest slope, a
/// bound of the distance from below. Immutable; any thread.
class ReliefDepth {
 public:
  /// Takes as much memory as the relief six times over. `relief` is not null.
  static Result<ReliefDepth> under(std::shared_ptr<const Relief> relief, const Work& work);

  /// Minus the depth and its gradient, at any finite place. Tick path.
  FieldSample sample(Vec3 place_m) const noexcept;

  double cell_m() const noexcept { return relief_->pixel_m(); }
  /// The greatest depth up to which it is the distance.
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
  /// Distance over height on the steepest slope.
  double steepest_rate_ = 1.0;
};

}  // namespace palpable::models
