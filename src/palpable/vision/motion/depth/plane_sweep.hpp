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

/// The line of sight of a pixel, of depth 1.
inline Vec3 line_of_sight(const Pinhole& camera, double x, double y) {
  return {(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0};
}

/// The costs of parallel planes: the reference and the pictures that it is compared with.
class PlaneSweep {
 public:
  static constexpr std::size_t kMostOthers = 16;

  /// 1 to kMostOthers other frames. The pictures need not outlive it.
  PlaneSweep(const PosedFrame& reference, std::span<const PosedFrame> others, const Pinhole& camera,
             const SweptPlanes& planes, const MultiViewOptions& options, const Work& work);

  /// Number of planes that are tried.
  int steps() const { return steps_; }
  /// Of a plane at a pixel.
  double inverse_depth(int x, int y, double step) const {
    const double inverse_distance =
        1 / planes_.far + step / (steps_ - 1) * (1 / planes_.near - 1 / planes_.far);
    return dot(planes_.normal, line_of_sight(camera_, x, y)) * inverse_distance;
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
  Pinhole camera_;
  SweptPlanes planes_;
  int steps_ = 0;
  double seen_share_ = 0.5;
  /// Costs of colour differences of 0 … 255 levels and of 0 … 63 census bits.
  std::array<std::uint16_t, 256> colour_cost_{};
  std::array<std::uint16_t, 64> census_cost_{};
};

}  // namespace palpable::vision
