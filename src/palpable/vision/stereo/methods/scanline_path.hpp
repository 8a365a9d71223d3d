// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace palpable::vision {

/// Costs of the moves of a scanline's path through its disparity-space image, in units of the matching cost.
struct PathOptions {
  /// A step of one disparity between neighbouring pixels, as on slanted surfaces: down, and up, which
  /// uses a pixel of the right picture twice; 0 … 200.
  float step_down = 24.0F;
  float step_up = 80.0F;
  /// A jump between pixels of one brightness; 0 … 200.
  float jump = 40.0F;
  /// Difference in brightness that halves the cost of a jump; levels of 255, 0.1 … 255.
  float edge_levels = 6.0F;
  /// Each pixel that only the left camera sees, in place of a matching cost; 0 … 200.
  float occluded = 68.0F;
  /// A ground control point has a cost below control_cost (0 … 144), and all other disparities cost more by
  /// the factor control_ratio (1 … 100). Leaving it costs control; 0 … 200.
  float control_cost = 20.0F;
  float control_ratio = 1.4F;
  float control = 20.0F;
};
std::vector<Parameter> parameters_of(PathOptions& options);

/// The least-cost path through one scanline's disparity-space image under ordering and occlusion constraints
/// (Shi & Pai 1997, section 2.1; Intille & Bobick 1994). Moves from column to column: stay or step by one
/// disparity; jump down (right occlusion: pixels that only the right camera sees); climb the diagonal (left
/// occlusion: pixels that only the left camera sees). Owns its scratch memory: one object per thread.
class ScanlinePath {
 public:
  /// The costs of the moves to a column, in units of path costs.
  struct MoveCosts {
    std::uint16_t step_down, step_up, jump, occluded;
  };

  /// `stride`: costs per pixel, a multiple of whole vectors, at least `disparities`.
  ScanlinePath(int width, int disparities, int stride, const PathOptions& options);

  /// `costs`: costs[x * stride + d] in units of 1/kMeanCostUnit, the padding has the maximum cost; `grey`:
  /// the left picture's row. Fills `disparity_px` with sub-pixel disparities; occluded pixels take the
  /// disparity of the surface behind, at their left. `occluded` gets 1 there.
  void find(std::span<const std::uint16_t> costs, std::span<const std::uint8_t> grey,
            std::span<float> disparity_px, std::span<std::uint8_t> occluded);

 private:
  void find_control_points(const std::uint16_t* costs);
  void step(const std::uint16_t* costs, const MoveCosts& move_costs, int control, std::uint8_t* moves);
  void walk_back(const std::uint16_t* costs, std::span<float> disparity_px, std::span<std::uint8_t> occluded);

  int width_;
  int disparities_;
  int stride_;
  PathOptions options_;
  std::array<std::uint16_t, 256> jump_cost_{};  // by contrast
  std::vector<int> control_;                    // the disparity of a column's ground control point, or -1
  // The best left column for each right column, and its cost; from right to left.
  std::vector<std::uint16_t> right_best_;
  std::vector<std::uint16_t> right_cost_;
  // Cost of the best path that ends in a match, or in an occlusion, at each disparity of the last and of this
  // column; and the least of the last ones.
  std::vector<std::uint16_t> match_, match_next_, occlusion_, occlusion_next_;
  std::vector<std::uint16_t> above_, above_too_;  // the best match_ of all higher disparities
  std::uint16_t base_ = 0;
  std::vector<std::uint16_t> wide_moves_;
  std::vector<std::uint8_t> moves_;
};

}  // namespace palpable::vision
