// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/orientation_score.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpable::measure {
namespace {

bool has_direction(const Directions& d, int x, int y) {
  return d.tangent_x(x, y) != 0.0F || d.tangent_y(x, y) != 0.0F;
}

bool same_size(const Raster<float>& a, const Raster<float>& b) {
  return a.width() == b.width() && a.height() == b.height();
}

/// The angle between two undirected lines, 0 ... 90 degrees.
double angle_between(const Directions& a, const Directions& b, int x, int y) {
  const double ax = a.tangent_x(x, y);
  const double ay = a.tangent_y(x, y);
  const double bx = b.tangent_x(x, y);
  const double by = b.tangent_y(x, y);
  return std::atan2(std::abs(ax * by - ay * bx), std::abs(ax * bx + ay * by)) * 180.0 / std::numbers::pi;
}

}  // namespace

Result<OrientationScore> score_orientation(const Directions& result, const Directions& truth,
                                           const OrientationScoreOptions& options) {
  for (const Directions* d : {&result, &truth})
    if (!same_size(d->tangent_x, result.strength) || !same_size(d->tangent_y, result.strength))
      return invalid_input("the result and the truth differ in size");
  if (!truth.strength.values().empty() && !same_size(truth.strength, result.strength))
    return invalid_input("the result and the truth differ in size");
  float greatest = 0.0F;
  for (const float s : result.strength.values()) greatest = std::max(greatest, s);
  const auto least = static_cast<float>(options.least_strength) * greatest;

  OrientationScore score;
  double sum = 0.0;
  double squares = 0.0;
  const int margin = std::max(0, options.margin_px);
  for (int y = margin; y < result.strength.height() - margin; ++y)
    for (int x = margin; x < result.strength.width() - margin; ++x) {
      if (!has_direction(truth, x, y) || !has_direction(result, x, y)) continue;
      if (!truth.strength.values().empty() && !(truth.strength(x, y) > 0.0F)) continue;
      if (!(result.strength(x, y) > 0.0F) || result.strength(x, y) < least) continue;
      const double error = angle_between(result, truth, x, y);
      ++score.pixels;
      score.max_deg = std::max(score.max_deg, error);
      sum += error;
      squares += error * error;
    }
  if (score.pixels == 0) return invalid_input("no pixel has a direction in both");
  score.mean_deg = sum / static_cast<double>(score.pixels);
  score.rms_deg = std::sqrt(squares / static_cast<double>(score.pixels));
  return score;
}

}  // namespace palpable::measure
