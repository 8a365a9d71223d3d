// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/image/colour_planes.hpp"
#include "palpable/vision/stereo/cost/matching_cost.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace palpable::vision {

struct CrossOptions {
  /// The longest arm along the row; px, 0 … 40.
  int row_reach_px = 17;
  /// The longest arm along the column: shorter, since slopes mostly run down a picture and a window should
  /// contain one disparity; px, 0 … 40.
  int column_reach_px = 6;
  /// An arm continues while every channel stays within this of the centre; levels of 255, 0 … 255.
  int colour_limit = 25;
  /// Beyond this length it continues within colour_limit_beyond only; px, 0 … 40.
  int sure_reach_px = 8;
  /// Levels of 255, 0 … 255.
  int colour_limit_beyond = 8;
  /// Colour limit for the next neighbour: with 255 a window is never a single pixel; levels, 0 … 255.
  int neighbour_limit = 255;
};
std::vector<Parameter> parameters_of(CrossOptions& options);

/// The arms of each pixel's window: its extent to the left, right, up and down within similar colour.
struct CrossArms {
  std::uint8_t left = 0, right = 0, up = 0, down = 0;
};
Raster<CrossArms> cross_arms(const ColourPlanes& picture, const CrossOptions& options, const Work& work);

/// Mean costs are integers in units of 1/kMeanCostUnit of the matching cost.
inline constexpr int kMeanCostUnit = 16;
/// Most pixels of a window, so that its sum fits 16 bits.
inline constexpr int kMostWindowPixels = 65535 / kLargestMatchingCost;
/// Errors: usage, for arms that could make a window too large for the aggregator.
Result<void> check_window_size(const CrossOptions& options);

/// Aggregates matching costs over cross-shaped windows (along the row's arms, then along the column's),
/// streaming down the picture: one scanline's disparity-space image at a time. One object per thread.
class CrossAggregator {
 public:
  /// The rows from first_row on are then requested in order. Windows must not exceed kMostWindowPixels.
  CrossAggregator(const MatchingCost& cost, const Raster<CrossArms>& arms, int disparities,
                  int column_reach_px, int first_row);

  /// Values per pixel: the disparities rounded up to whole vectors; the padding has the maximum cost.
  int stride() const { return stride_; }
  /// The next row's mean cost over its window, out[x * stride() + d], in units of 1/kMeanCostUnit.
  void next_row(std::uint16_t* out);

 private:
  void add_row();
  std::uint16_t* sums(int row);

  const MatchingCost& cost_;
  const Raster<CrossArms>& arms_;
  int disparities_;
  int stride_;
  int reach_;
  int row_;     // the next to return
  int summed_;  // the next to sum
  int ring_;    // rows kept
  std::vector<std::uint8_t> raw_;
  std::vector<std::uint16_t> prefix_;               // of one row, along x
  std::vector<std::uint16_t> sums_;                 // ring of rows, summed down the columns
  std::vector<std::vector<std::uint32_t>> pixels_;  // ring: window pixels summed down the columns
};

/// Averaging of costs over small windows against the noise of single pixels; a smoothness term handles
/// surfaces.
struct AggregationOptions {
  CostOptions cost = {};
  CrossOptions window = {.row_reach_px = 3, .column_reach_px = 3, .sure_reach_px = 1};
  /// Truncation of mean costs; units of the matching cost, 1 … 144.
  float limit = 60.0F;
};
std::vector<Parameter> parameters_of(AggregationOptions& options);

/// The whole pair's costs over cross-shaped windows, truncated and rounded: [(y * width + x) * disparities +
/// d].
std::vector<std::uint8_t> aggregated_costs(const MatchInput& input, const AggregationOptions& options,
                                           const Work& work);

}  // namespace palpable::vision
