// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/rectification/feature_matches.hpp"

#include <optional>
#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// The vertical offset of the right picture's rows from the left one's, varying smoothly over the picture, as
/// a rolling shutter, a loose scan or a tape makes it: what no rotation of the cameras explains.
class VerticalOffsets {
 public:
  /// A smooth surface through the matches' offsets: a uniform cubic B-spline, fitted with robust weights that
  /// narrow from round to round. nullopt for too few matches.
  static std::optional<VerticalOffsets> through(const std::vector<FeatureMatch>& matches, int width,
                                                int height, const VerticalOffsetOptions& options = {});

  /// What lies on row y of the left picture, at column x of the right one, lies so many rows lower there.
  double offset_px(double x, double y) const;
  /// The match with its right place moved by the surface, to the left picture's row.
  FeatureMatch corrected(const FeatureMatch& match) const;

 private:
  VerticalOffsets(int width, int height, int across, int down)
      : width_(width), height_(height), across_(across), down_(down) {}
  double width_, height_;
  int across_, down_;
  /// across_ x down_ control values, row by row.
  std::vector<double> control_;
};

/// How well such surfaces explain matches that they were not fitted to (two-fold cross-validation): a surface
/// of so many numbers could fit anything.
struct VerticalOffsetScore {
  /// Matches within the tolerance once corrected, and RMS of what is left over them.
  std::size_t inliers = 0;
  double residual_px = 0.0;
  /// The greatest offset at any of them, from their median.
  double greatest_px = 0.0;
  /// Better than another model with so many inliers and such a residual by enough to justify its parameters.
  bool is_better_than(std::size_t other_inliers, double other_px, const VerticalOffsetOptions& options) const;
};
VerticalOffsetScore cross_validate_offsets(const std::vector<FeatureMatch>& matches, int width, int height,
                                           double tolerance_px, const VerticalOffsetOptions& options = {});

}  // namespace palpable::vision
