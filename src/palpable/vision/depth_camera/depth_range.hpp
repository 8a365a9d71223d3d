// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

#include <optional>

namespace palpable::vision {

/// Depths from near to far, metres.
struct DepthRange {
  double near_m = 0.0;
  double far_m = 0.0;
};

/// The range of the known depths without the nearest and farthest 1 %, wider by a tenth on either side (near
/// by at most half of itself); at least 1 cm. nullopt if no pixel is known.
std::optional<DepthRange> range_of_depths(const Raster<float>& depth_m);

/// The range for a live relief: that of the first frame, so that surfaces stay where they are. Where for
/// `patience_s` on end more than a twentieth of the known pixels lie outside, or the depths fill less than a
/// third, it moves to the range of what is seen, by at most a fifth of itself a second. One thread.
class FollowedRange {
 public:
  explicit FollowedRange(double patience_s = 1.0) : patience_s_(patience_s) {}

  /// The range for this frame, `dt_s` after the previous one; nullopt until a frame has a known pixel.
  std::optional<DepthRange> add(const Raster<float>& depth_m, double dt_s);

 private:
  double patience_s_;
  std::optional<DepthRange> range_;
  double unsuited_s_ = 0.0;
};

}  // namespace palpable::vision
