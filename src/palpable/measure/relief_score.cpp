// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/relief_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::measure {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr float kFeltSlope = 0.02F;
/// The reach of a silhouette in the detail band: at 3.3 standard deviations of its wider filter, a step of 10
/// mm leaves 5 um.
constexpr int kSilhouetteReach = 10;
constexpr int kStepReach = 4;
constexpr float kStepOfRange = 0.05F;

/// Per pixel: the truth in the scene's own proportions, the relief, and the masks.
struct Pair {
  cv::Mat truth;
  cv::Mat relief;
  /// 255 where the truth is known.
  cv::Mat known;
  /// 255 near a silhouette.
  cv::Mat silhouettes;
};

cv::Mat blurred(const cv::Mat& values, double sigma) {
  cv::Mat out;
  cv::GaussianBlur(values, out, {}, sigma, sigma, cv::BORDER_REPLICATE);
  return out;
}

/// Band-pass filter (difference of Gaussians) for forms of 1 to 3 pixels.
cv::Mat detail_band(const cv::Mat& values) { return blurred(values, 1.0) - blurred(values, 3.0); }

struct Slopes {
  cv::Mat x;
  cv::Mat y;
};

Slopes slopes(const cv::Mat& z, double pixel_m) {
  Slopes s;
  const cv::Mat kernel = (cv::Mat_<float>(1, 3) << -1.0F, 0.0F, 1.0F) * (0.5 / pixel_m);
  cv::filter2D(z, s.x, CV_32F, kernel, {-1, -1}, 0, cv::BORDER_REPLICATE);
  cv::filter2D(z, s.y, CV_32F, kernel.t(), {-1, -1}, 0, cv::BORDER_REPLICATE);
  return s;
}

/// Unknown pixels take the value of the nearest known one to the left, else to the right, else above. This
/// only avoids spurious steps in the filters; these pixels are not scored.
cv::Mat filled(const Raster<float>& nearness, cv::Mat& known) {
  cv::Mat z(nearness.height(), nearness.width(), CV_32F);
  known.create(z.size(), CV_8U);
  for (int y = 0; y < z.rows; ++y) {
    float last = std::numeric_limits<float>::quiet_NaN();
    for (int x = 0; x < z.cols; ++x) {
      const float v = nearness(x, y);
      known.at<std::uint8_t>(y, x) = std::isfinite(v) ? 255 : 0;
      if (std::isfinite(v)) last = v;
      z.at<float>(y, x) = last;
    }
    for (int x = z.cols - 1; x >= 0; --x) {
      float& v = z.at<float>(y, x);
      if (std::isnan(v) && x + 1 < z.cols) v = z.at<float>(y, x + 1);
      if (std::isnan(v) && y > 0) v = z.at<float>(y - 1, x);
    }
  }
  // Rows above the first known row.
  for (int y = z.rows - 2; y >= 0; --y)
    for (int x = 0; x < z.cols; ++x)
      if (std::isnan(z.at<float>(y, x))) z.at<float>(y, x) = z.at<float>(y + 1, x);
  return z;
}

void find_silhouettes(Pair& pair, const Slopes& truth, double steepest_slope) {
  cv::Mat slope;
  cv::magnitude(truth.x, truth.y, slope);
  pair.silhouettes = slope > 2.0 * steepest_slope;
  cv::Mat unknown = pair.known == 0;
  cv::bitwise_or(pair.silhouettes, unknown, pair.silhouettes);
  cv::dilate(pair.silhouettes, pair.silhouettes,
             cv::Mat::ones(2 * kSilhouetteReach + 1, 2 * kSilhouetteReach + 1, CV_8U));
  // The filters extrapolate the border as level, so that a slope seems to bend there.
  cv::rectangle(pair.silhouettes, {0, 0}, {pair.silhouettes.cols - 1, pair.silhouettes.rows - 1}, 255,
                2 * kSilhouetteReach - 1);
}

double reversed_percent(const Pair& pair, const Slopes& truth, const Slopes& relief) {
  std::size_t scored = 0;
  std::size_t reversed = 0;
  for (int y = 0; y < pair.truth.rows; ++y)
    for (int x = 0; x < pair.truth.cols; ++x) {
      if (pair.silhouettes.at<std::uint8_t>(y, x) != 0) continue;
      ++scored;
      const cv::Point2f t(truth.x.at<float>(y, x), truth.y.at<float>(y, x));
      const cv::Point2f r(relief.x.at<float>(y, x), relief.y.at<float>(y, x));
      if (std::hypot(t.x, t.y) > kFeltSlope && std::hypot(r.x, r.y) > kFeltSlope && t.dot(r) < 0.0F)
        ++reversed;
    }
  return scored > 0 ? 100.0 * static_cast<double>(reversed) / static_cast<double>(scored) : 0.0;
}

double band_correlation(const Pair& pair, const cv::Mat& truth, const cv::Mat& relief) {
  cv::Mat weight;
  cv::Mat away = pair.silhouettes == 0;
  away.convertTo(weight, CV_32F, 1.0 / 255.0);
  constexpr double kWindow = 8.0;
  const cv::Mat total = blurred(weight, kWindow) + 1e-6F;
  const auto mean = [&](const cv::Mat& values) -> cv::Mat {
    return blurred(values.mul(weight), kWindow) / total;
  };
  const cv::Mat mean_t = mean(truth);
  const cv::Mat mean_r = mean(relief);
  const cv::Mat var_t = mean(truth.mul(truth)) - mean_t.mul(mean_t);
  const cv::Mat var_r = mean(relief.mul(relief)) - mean_r.mul(mean_r);
  const cv::Mat covariance = mean(truth.mul(relief)) - mean_t.mul(mean_r);
  // Deviations below kLeast_m are rounding errors; above kMost_m they get no more weight.
  constexpr float kLeast_m = 5e-6F;
  constexpr float kMost_m = 2e-4F;
  double sum = 0.0;
  double weights = 0.0;
  for (int y = 0; y < truth.rows; ++y)
    for (int x = 0; x < truth.cols; ++x) {
      if (pair.silhouettes.at<std::uint8_t>(y, x) != 0) continue;
      const float deviation = std::sqrt(std::max(0.0F, var_t.at<float>(y, x)));
      if (deviation < kLeast_m) continue;
      const double w = std::min(deviation, kMost_m);
      const double norm = double{deviation} * std::sqrt(std::max(1e-18, double{var_r.at<float>(y, x)}));
      sum += w * std::clamp(double{covariance.at<float>(y, x)} / norm, -1.0, 1.0);
      weights += w;
    }
  return weights > 0.0 ? sum / weights : kUndefined;
}

void count_order(const Pair& pair, float step_m, std::size_t& steps, std::size_t& wrong) {
  const auto look = [&](int x, int y, int x1, int y1) {
    if (pair.known.at<std::uint8_t>(y, x) == 0 || pair.known.at<std::uint8_t>(y1, x1) == 0) return;
    const float t = pair.truth.at<float>(y1, x1) - pair.truth.at<float>(y, x);
    if (std::abs(t) <= step_m) return;
    ++steps;
    wrong += t * (pair.relief.at<float>(y1, x1) - pair.relief.at<float>(y, x)) <= 0.0F ? 1U : 0U;
  };
  for (int y = 0; y < pair.truth.rows; ++y)
    for (int x = 0; x < pair.truth.cols; ++x) {
      if (x + kStepReach < pair.truth.cols) look(x, y, x + kStepReach, y);
      if (y + kStepReach < pair.truth.rows) look(x, y, x, y + kStepReach);
    }
}

void count_details(const Pair& pair, const cv::Mat& truth, const cv::Mat& relief,
                   const ReliefScoreOptions& options, std::size_t& details, std::size_t& kept) {
  const cv::Mat size = cv::abs(truth);
  cv::Mat greatest;
  cv::dilate(size, greatest, cv::Mat::ones(7, 7, CV_8U));
  for (int y = 0; y < truth.rows; ++y)
    for (int x = 0; x < truth.cols; ++x) {
      const float here = size.at<float>(y, x);
      if (pair.silhouettes.at<std::uint8_t>(y, x) != 0 || here < greatest.at<float>(y, x) ||
          double{here} < options.detail_m)
        continue;
      ++details;
      const float felt = relief.at<float>(y, x);
      kept += felt * truth.at<float>(y, x) > 0.0F && double{std::abs(felt)} >= options.felt_m ? 1U : 0U;
    }
}

double percent(std::size_t part, std::size_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : kUndefined;
}

}  // namespace

double ReliefScore::sum() const {
  const auto or_zero = [](double v) { return std::isnan(v) ? 0.0 : v; };
  return reversed_slopes_percent + 100.0 * (std::isnan(detail_correlation) ? 0.0 : 1.0 - detail_correlation) +
         or_zero(wrong_order_percent) +
         (std::isnan(details_kept_percent) ? 0.0 : 100.0 - details_kept_percent);
}

Result<ReliefScore> score_relief(const Raster<float>& height_m, double pixel_m, const Raster<float>& nearness,
                                 const ReliefScoreOptions& options) {
  if (height_m.width() != nearness.width() || height_m.height() != nearness.height())
    return invalid_input("the relief and the depth differ in size");
  if (height_m.width() < 16 || height_m.height() < 16)
    return invalid_input("a relief below 16 x 16 cannot be scored");
  Pair pair;
  pair.truth = filled(nearness, pair.known);
  pair.relief = cv::Mat(height_m.height(), height_m.width(), CV_32F);
  std::copy(height_m.values().begin(), height_m.values().end(), pair.relief.begin<float>());
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(pair.truth, &low, &high, nullptr, nullptr, pair.known);
  double relief_low = 0.0;
  double relief_high = 0.0;
  cv::minMaxLoc(pair.relief, &relief_low, &relief_high);
  if (!(high > low)) return invalid_input("the depth has only one level");
  const double scene_height_m =
      options.scene_height_m.value_or(options.compression * (relief_high - relief_low));
  pair.truth.convertTo(pair.truth, CV_32F, scene_height_m / (high - low),
                       -low * scene_height_m / (high - low));

  const Slopes truth = slopes(pair.truth, pixel_m);
  const Slopes relief = slopes(pair.relief, pixel_m);
  find_silhouettes(pair, truth, options.steepest_slope);
  const cv::Mat truth_band = detail_band(pair.truth);
  const cv::Mat relief_band = detail_band(pair.relief);

  ReliefScore score;
  score.reversed_slopes_percent = reversed_percent(pair, truth, relief);
  score.detail_correlation = band_correlation(pair, truth_band, relief_band);
  std::size_t wrong = 0;
  count_order(pair, kStepOfRange * static_cast<float>(scene_height_m), score.depth_steps, wrong);
  score.wrong_order_percent = percent(wrong, score.depth_steps);
  cv::Mat slope;
  cv::magnitude(relief.x, relief.y, slope);
  double steepest = 0.0;
  cv::minMaxLoc(slope, nullptr, &steepest);
  score.greatest_slope = steepest;
  std::size_t kept = 0;
  count_details(pair, truth_band, relief_band, options, score.details, kept);
  score.details_kept_percent = percent(kept, score.details);
  return score;
}

}  // namespace palpable::measure
