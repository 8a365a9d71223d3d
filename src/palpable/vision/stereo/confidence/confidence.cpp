// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/confidence/confidence.hpp"

#include "palpable/vision/image/opencv_image.hpp"
#include "palpable/vision/stereo/confidence/match_margin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// What only one camera saw is inferred.
constexpr double kHiddenShare = 0.5;
constexpr int kStepReach_px = 6;
constexpr float kStep_px = 1.0F, kMostStep_px = 4.0F;
constexpr float kMeasuredMargin = 2.0F, kMeasuredCost = 30.0F, kMostDistance_px = 60.0F;

/// The least known value in the square around each pixel; infinite if there is none. NaN compares false.
Raster<float> local_least(const Raster<float>& values, int reach_px) {
  const int width = values.width(), height = values.height();
  Raster<float> along(width, height, std::numeric_limits<float>::infinity()), out = along;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int u = std::max(0, x - reach_px); u <= std::min(width - 1, x + reach_px); ++u)
        if (values(u, y) < along(x, y)) along(x, y) = values(u, y);
  for (int y = 0; y < height; ++y)
    for (int v = std::max(0, y - reach_px); v <= std::min(height - 1, y + reach_px); ++v)
      for (int x = 0; x < width; ++x) out(x, y) = std::min(out(x, y), along(x, v));
  return out;
}

/// 1 where another pixel of the result's row, nearer by more than a pixel, has the same match.
Raster<std::uint8_t> hidden_by_nearer(const Raster<float>& disparity_px) {
  const int width = disparity_px.width();
  Raster<std::uint8_t> out(width, disparity_px.height());
  std::vector<float> nearest(static_cast<std::size_t>(width));
  const auto match_of = [&](int x, int y) {
    const float there = static_cast<float>(x) - disparity_px(x, y);
    return there >= -0.5F && there < static_cast<float>(width) - 0.5F ? static_cast<int>(std::lround(there))
                                                                      : -1;
  };
  for (int y = 0; y < out.height(); ++y) {
    std::fill(nearest.begin(), nearest.end(), -std::numeric_limits<float>::infinity());
    for (int x = 0; x < width; ++x)
      if (const int at = match_of(x, y); at >= 0) {
        float& d = nearest[static_cast<std::size_t>(at)];
        d = std::max(d, disparity_px(x, y));
      }
    for (int x = 0; x < width; ++x) {
      const int at = match_of(x, y);
      out(x, y) = at < 0 || nearest[static_cast<std::size_t>(at)] > disparity_px(x, y) + kStep_px ? 1 : 0;
    }
  }
  return out;
}

/// The distance of each pixel to the nearest one with a 0; everywhere the most if there is none.
Raster<float> distance_to_zeros(const Raster<std::uint8_t>& mask) {
  Raster<float> out(mask.width(), mask.height(), kMostDistance_px);
  if (std::find(mask.values().begin(), mask.values().end(), 0) == mask.values().end()) return out;
  cv::Mat distance(out.height(), out.width(), CV_32F, out.data());
  cv::distanceTransform(grey_view_of(mask), distance, cv::DIST_L2, 3);
  for (float& d : out.values()) d = std::min(d, kMostDistance_px);
  return out;
}

/// The logit of one pixel.
double logit(const MatchEvidence& evidence, int x, int y, const ConfidenceOptions& o) {
  const double margin = std::clamp(static_cast<double>(evidence.margin(x, y)), -10.0, 10.0);
  const double away = std::log1p(static_cast<double>(evidence.distance_px(x, y)));
  return o.constant + o.margin * margin + o.margin_above_2 * std::max(0.0, margin - 2.0) +
         o.above * static_cast<double>(evidence.above_px(x, y)) + o.distance * away +
         o.distance_above_1_5 * std::max(0.0, away - 1.5);
}

}  // namespace

std::vector<Parameter> parameters_of(ConfidenceOptions& o) {
  constexpr ParameterRange kAny{-20, 20};
  return {{"constant", &o.constant, kAny, "", "Constant of the logistic regression"},
          {"margin", &o.margin, kAny, "", "Weight of the margin to the next best match"},
          {"margin_above_2", &o.margin_above_2, kAny, "", "More for the margin above 2"},
          {"above", &o.above, kAny, "1/px", "Weight of a farther surface beside the pixel"},
          {"distance", &o.distance, kAny, "", "Weight of the distance to the nearest measured pixel"},
          {"distance_above_1_5", &o.distance_above_1_5, kAny, "", "More for larger distances"}};
}

MatchEvidence match_evidence(const MatchInput& input, const Raster<float>& disparity_px, const Work& work) {
  MatchMargin matched = match_margin(input, disparity_px, work);
  Raster<float> above_px = local_least(disparity_px, kStepReach_px);
  Raster<std::uint8_t> hidden = hidden_by_nearer(disparity_px), unmeasured = hidden;
  for (std::size_t i = 0; i < disparity_px.count(); ++i) {
    float& above = above_px.values()[i];
    above = std::clamp(disparity_px.values()[i] - above - kStep_px, 0.0F, kMostStep_px);
    if (matched.margin.values()[i] <= kMeasuredMargin || matched.cost.values()[i] >= kMeasuredCost)
      unmeasured.values()[i] = 1;
  }
  return {std::move(matched.margin), std::move(above_px), distance_to_zeros(unmeasured), std::move(hidden)};
}

Raster<float> confidence_of(const MatchInput& input, const Raster<float>& disparity_px,
                            const ConfidenceOptions& options, const Work& work) {
  const MatchEvidence evidence = match_evidence(input, disparity_px, work);
  Raster<float> out(disparity_px.width(), disparity_px.height());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x)
      if (std::isfinite(disparity_px(x, y)))
        out(x, y) = static_cast<float>((evidence.hidden(x, y) != 0 ? kHiddenShare : 1.0) /
                                       (1.0 + std::exp(-logit(evidence, x, y, options))));
  return out;
}

}  // namespace palpable::vision
