// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/score/score_json.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace palpable::cli {

Result<DisparityScores> scores_of(const Raster<float>& result_px, const Raster<float>& truth_px,
                                  const Raster<std::uint8_t>& mask) {
  const auto pixels = measure::score_disparity(result_px, truth_px, mask);
  if (!pixels) return pixels.error();
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto touch = measure::touch_of_disparity(result_px, truth_px, mask);
  return DisparityScores{*pixels, touch ? *touch : measure::DisparityTouch{kNone, kNone, 0.0}};
}

Json json_of(const DisparityScores& scores) {
  const auto or_null = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
  Json bad;
  for (std::size_t i = 0; i < measure::kBadThresholds_px.size(); ++i)
    bad[fmt::format("{:g}", measure::kBadThresholds_px[i])] = scores.pixels.bad_percent[i];
  return {{"pixels", scores.pixels.pixels},
          {"coverage", scores.pixels.coverage},
          {"bad", bad},
          {"rms_px", or_null(scores.pixels.rms_px)},
          {"rms_percent_of_range", or_null(scores.pixels.rms_percent_of_range)},
          {"normal_error_deg", or_null(scores.touch.normal_error_deg)},
          {"spurious_steps_per_cm", or_null(scores.touch.spurious_steps_per_cm)},
          {"path_cm", scores.touch.path_cm}};
}

double coverage_of(const Raster<float>& disparity_px) {
  const auto known = std::count_if(disparity_px.values().begin(), disparity_px.values().end(),
                                   [](float d) { return std::isfinite(d); });
  return static_cast<double>(known) / static_cast<double>(disparity_px.count());
}

}  // namespace palpable::cli
