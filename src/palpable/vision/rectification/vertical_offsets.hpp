// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/rectification/feature_matches.hpp"

#include <optional>
#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// A smoothly varying vertical offset between the rows of both pictures that no rotation of the cameras
/// explains, as from a rolling shutter, a loose scan or a video tape.
class VerticalOffsets {
 public:
  /// Fits a smooth surface to the matches' offsets: a uniform cubic B-spline, by iteratively reweighted least
  /// squares with a decreasing scale. nullopt for too few matches.
  static std::optional<VerticalOffsets> through(const std::vector<FeatureMatch>& matches, int width,
                                                int height, const VerticalOffsetOptions& options = {});

  /// The offset at row y of the left picture and column x of the right one: how many rows lower the right
  /// picture shows the point.
  double offset_px(double x, double y) const;
  /// The match with its right point corrected by the offset.
  FeatureMatch corrected(const FeatureMatch& match) const;

 private:
  VerticalOffsets(int width, int height, int across, int down)
      : width_(width), height_(height), across_(across), down_(down) {}
  double width_, height_;
  int across_, down_;
  /// across_ x down_ control values, row by row.
  std::vector<double> control_;
};

/// The two-fold cross-validation of such surfaces, since their many parameters could overfit.
struct VerticalOffsetScore {
  /// Matches within the tolerance after correction, and their RMS residual.
  std::size_t inliers = 0;
  double residual_px = 0.0;
  /// The greatest offset at any of them, from their median.
  double greatest_px = 0.0;
  /// Whether it is better than another model with these inliers and this residual by enough to justify its
  /// parameters.
  bool is_better_than(std::size_t other_inliers, double other_px, const VerticalOffsetOptions& options) const;
};
VerticalOffsetScore cross_validate_offsets(const std::vector<FeatureMatch>& matches, int width, int height,
                                           double tolerance_px, const VerticalOffsetOptions& options = {});

}  // namespace palpable::vision
