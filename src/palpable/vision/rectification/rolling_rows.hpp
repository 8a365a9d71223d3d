// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/rectification/feature_matches.hpp"

#include <optional>
#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// How far the right picture's rows lie from the left one's where that rolls over the picture, as a rolling
/// shutter, a loose scan or a tape makes it: what no turn of the cameras explains.
class RollingRows {
 public:
  /// A smooth surface through the matches' offsets (a cubic B-spline of a few control values, more down the
  /// picture than across, the outliers' weight falling as the fit closes in). nullopt for too few matches.
  static std::optional<RollingRows> through(const std::vector<FeatureMatch>& matches, int width, int height);

  /// What lies on row y of the left picture, at column x of the right one, lies so many rows lower there.
  double offset_px(double x, double y) const;
  /// The match with its right place on the left picture's row, as far as the surface tells.
  FeatureMatch evened(const FeatureMatch& match) const;

 private:
  static constexpr int kAcross = 8, kDown = 13;
  RollingRows(int width, int height) : width_(width), height_(height) {}
  double width_, height_;
  /// kAcross x kDown control values, row by row.
  std::vector<double> control_;
};

/// How well rolling surfaces explain matches that they were not fitted to: half of the matches tells of the
/// other half, and the other way round. A surface of so many numbers could fit anything.
struct RollingGain {
  /// Matches within the tolerance once evened, and RMS of what is left over them.
  std::size_t agree = 0;
  double residual_px = 0.0;
  /// The greatest offset at any of them, from their median.
  double greatest_px = 0.0;
  /// Worth its many free numbers, where another explanation has so many agree and leaves so much.
  bool worth_it(std::size_t other_agree, double other_px) const;
};
RollingGain rolling_gain(const std::vector<FeatureMatch>& matches, int width, int height,
                         double tolerance_px);

}  // namespace palpable::vision
