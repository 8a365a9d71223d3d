// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/disparity_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace palpable::measure {
namespace {

std::string size_of(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

Result<void> same_size(const Raster<float>& truth, int width, int height, const char* what) {
  if (truth.width() == width && truth.height() == height) return {};
  return invalid_input(std::string("the ") + what + " has " + size_of(width, height) +
                       " pixels, but the truth has " + size_of(truth.width(), truth.height()));
}

}  // namespace

Result<DisparityScore> score_disparity(const Raster<float>& result_px, const Raster<float>& truth_px,
                                       const Raster<std::uint8_t>& mask) {
  if (const auto ok = same_size(truth_px, result_px.width(), result_px.height(), "result"); !ok)
    return ok.error();
  if (!mask.empty())
    if (const auto ok = same_size(truth_px, mask.width(), mask.height(), "mask"); !ok) return ok.error();

  DisparityScore score;
  std::array<std::size_t, kBadThresholds_px.size()> bad{};
  std::size_t known = 0;
  double squares = 0.0;
  float low = std::numeric_limits<float>::infinity();
  float high = -low;
  for (std::size_t i = 0; i < truth_px.count(); ++i) {
    const float truth = truth_px.values()[i];
    if (!std::isfinite(truth) || (!mask.empty() && mask.values()[i] != 255)) continue;
    ++score.pixels;
    low = std::min(low, truth);
    high = std::max(high, truth);
    const float result = result_px.values()[i];
    const bool is_known = std::isfinite(result);
    const double error = is_known ? std::abs(static_cast<double>(result) - static_cast<double>(truth))
                                  : std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < bad.size(); ++t) bad[t] += error > kBadThresholds_px[t] ? 1U : 0U;
    if (!is_known) continue;
    ++known;
    squares += error * error;
  }
  if (score.pixels == 0)
    return invalid_input(mask.empty() ? "the truth has no known pixel"
                                      : "the mask excludes every known pixel of the truth");
  const auto pixels = static_cast<double>(score.pixels);
  score.coverage = static_cast<double>(known) / pixels;
  for (std::size_t t = 0; t < bad.size(); ++t)
    score.bad_percent[t] = 100.0 * static_cast<double>(bad[t]) / pixels;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  score.rms_px = known > 0 ? std::sqrt(squares / static_cast<double>(known)) : nan;
  score.rms_percent_of_range = high > low ? 100.0 * score.rms_px / static_cast<double>(high - low) : nan;
  return score;
}

}  // namespace palpable::measure
