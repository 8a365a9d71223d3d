// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/motion/depth/multi_view_depth.hpp"
#include "palpable/vision/stereo/cost/cost_volume.hpp"
#include "palpable/vision/stereo/cost/matching_cost.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace palpable::vision {

/// Where a pixel of the reference appears in another picture: (at_infinity * (x, y, 1) + w *
/// per_inverse_depth), in homogeneous coordinates, at inverse depth w.
struct EpipolarLine {
  std::array<double, 9> at_infinity{};
  std::array<double, 3> per_inverse_depth{};

  EpipolarLine(const PosedFrame& reference, const PosedFrame& other, const Pinhole& camera);
  std::array<double, 3> start(int x, int y) const;
  /// In pixels.
  std::array<double, 2> place(int x, int y, double inverse_depth) const;
};

/// The costs of planes of constant depth: the reference and the pictures that it is compared with.
class PlaneSweep {
 public:
  static constexpr std::size_t kMostOthers = 16;

  /// 1 to kMostOthers other frames. The pictures need not outlive it.
  PlaneSweep(const PosedFrame& reference, std::span<const PosedFrame> others, const Pinhole& camera,
             DepthSpan span, const MultiViewOptions& options, const Work& work);

  /// Number of depths that are tried.
  int steps() const { return steps_; }
  double inverse_depth(double step) const {
    return 1 / span_.far + step / (steps_ - 1) * (1 / span_.near - 1 / span_.far);
  }
  const MatchView& reference() const { return reference_; }
  /// The matching cost of each pixel at each step: the mean of the least costs over the counted share of the
  /// other pictures that see it; 1 unit where none does. `volume` has the camera's size and steps() values.
  void fill(CostVolume& volume, const Work& work) const;

 private:
  struct OtherView {
    Raster<std::uint64_t> census;
    /// Red, green and blue in one number.
    Raster<std::uint32_t> colour;
    EpipolarLine line;
  };
  void costs_in(const OtherView& other, int x, int y, std::int32_t* places, std::uint16_t* out) const;

  MatchView reference_;
  std::vector<OtherView> others_;
  DepthSpan span_;
  int steps_ = 0;
  double seen_share_ = 0.5;
  /// Costs of colour differences of 0 … 255 levels and of 0 … 63 census bits.
  std::array<std::uint16_t, 256> colour_cost_{};
  std::array<std::uint16_t, 64> census_cost_{};
};

}  // namespace palpable::vision
