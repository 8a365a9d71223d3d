// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/photograph_check.hpp"

#include "palpable/core/numbers/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

std::vector<float> samples_of(const cv::Mat& values) { return {values.begin<float>(), values.end<float>()}; }

/// Standard deviation of the noise: the median absolute response of Immerkær's mask, which gives 0 on any
/// quadratic surface and sums 36 independent variances. The median ignores edges.
double noise_of(const cv::Mat& luma) {
  static const cv::Mat kMask = (cv::Mat_<float>(3, 3) << 1, -2, 1, -2, 4, -2, 1, -2, 1);
  constexpr double kMedianOfNormal = 0.6745, kMaskGain = 6.0;
  cv::Mat response;
  cv::filter2D(luma, response, CV_32F, kMask, {-1, -1}, 0.0, cv::BORDER_REFLECT_101);
  std::vector<float> sizes = samples_of(cv::abs(response));
  return double{quantile_of(sizes, 0.5)} / (kMedianOfNormal * kMaskGain);
}

/// The greatest level (sign 1; least: -1) on the way from (x, y) by steps of one pixel along (dx, dy), which
/// ends where the level comes back by more than `tolerance`, and after kMostSteps.
double end_level(const cv::Mat& luma, double x, double y, double dx, double dy, double sign,
                 double tolerance) {
  constexpr int kMostSteps = 30;
  const auto level = [&luma](double u, double v) {
    return double{luma.at<float>(static_cast<int>(std::lround(v)), static_cast<int>(std::lround(u)))};
  };
  double best = level(x, y);
  for (int k = 0; k < kMostSteps; ++k) {
    x += dx, y += dy;
    if (x < 0.0 || y < 0.0 || x > luma.cols - 1.0 || y > luma.rows - 1.0) return best;
    const double next = level(x, y);
    if (sign * (next - best) > 0.0) best = next;
    if (sign * (next - best) < -tolerance) return best;
  }
  return best;
}

/// The median width of the steepest edges as a share of the longer side: the difference of levels across an
/// edge over its slope. On a smoothed copy of at most 500 pixels, whose noise is less than that of the
/// picture.
double blur_of(const cv::Mat& full, double noise) {
  constexpr double kMostSide = 500.0;
  constexpr double kSteepest = 0.995, kSteep = 0.6;
  cv::Mat luma = full.clone();
  const double scale = kMostSide / std::max(full.cols, full.rows);
  if (scale < 1.0) cv::resize(full, luma, {}, scale, scale, cv::INTER_AREA);
  cv::GaussianBlur(luma, luma, {}, 1.0, 1.0, cv::BORDER_REPLICATE);
  cv::Mat dx, dy, slope;
  cv::Sobel(luma, dx, CV_32F, 1, 0, 3, 1.0 / 8.0);
  cv::Sobel(luma, dy, CV_32F, 0, 1, 3, 1.0 / 8.0);
  cv::magnitude(dx, dy, slope);
  std::vector<float> slopes = samples_of(slope);
  const double steep = kSteep * double{quantile_of(slopes, kSteepest)};
  constexpr double kNoEdge = 1e-4;
  if (steep < kNoEdge) return 0.0;
  std::vector<double> widths;
  for (int y = 0; y < luma.rows; ++y)
    for (int x = 0; x < luma.cols; ++x) {
      const double s = double{slope.at<float>(y, x)};
      if (s < steep) continue;
      const double ux = double{dx.at<float>(y, x)} / s, uy = double{dy.at<float>(y, x)} / s;
      widths.push_back(
          (end_level(luma, x, y, ux, uy, 1.0, noise) - end_level(luma, x, y, -ux, -uy, -1.0, noise)) / s);
    }
  return quantile_of(widths, 0.5) / std::max(luma.cols, luma.rows);
}

}  // namespace

std::vector<Parameter> parameters_of(PhotographCheckOptions& o) {
  return {{"dark_level", &o.dark_level, {0, 1}, "", "brightest parts of a dark picture"},
          {"least_contrast", &o.least_contrast, {0, 1}, "", "contrast below which lines are faint"},
          {"most_noise", &o.most_noise, {0, 1}, "", "greatest noise, share of the contrast"},
          {"most_blur", &o.most_blur, {0, 1}, "", "greatest width of edges, share of the longer side"}};
}

PhotographQuality photograph_quality(const Image& image) {
  Raster<float> grey_levels = grey(image);
  const cv::Mat luma(grey_levels.height(), grey_levels.width(), CV_32F, grey_levels.data());
  PhotographQuality quality;
  cv::Mat smooth;
  cv::GaussianBlur(luma, smooth, {}, 1.0, 1.0, cv::BORDER_REPLICATE);
  double darkest = 0.0;
  cv::minMaxLoc(smooth, &darkest, &quality.brightness);
  quality.contrast = quality.brightness - darkest;
  quality.noise = noise_of(luma);
  quality.blur = blur_of(luma, quality.noise);
  return quality;
}

std::string photograph_verdict(const PhotographQuality& quality, const PhotographCheckOptions& options) {
  std::vector<std::string> wrong, advice;
  const auto percent = [](double share) { return fmt::format("{:.0f} %", 100.0 * share); };
  if (quality.brightness < options.dark_level) {
    wrong.push_back(fmt::format("dark (its brightest parts reach {} of white)", percent(quality.brightness)));
    advice.emplace_back("in brighter light");
  } else if (quality.contrast < options.least_contrast) {
    wrong.push_back(fmt::format("faint (its levels span {} of black to white)", percent(quality.contrast)));
    advice.emplace_back("in even light, drawn with darker lines");
  }
  if (quality.noise > options.most_noise * quality.contrast) {
    wrong.push_back(fmt::format("noisy (noise is {} of its contrast)",
                                percent(quality.noise / std::max(quality.contrast, 1e-9))));
    if (advice.empty()) advice.emplace_back("in brighter light");
  }
  if (quality.blur > options.most_blur) {
    wrong.push_back(fmt::format("blurred (its sharpest edges are {} of its longer side wide)",
                                fmt::format("{:.1f} %", 100.0 * quality.blur)));
    advice.emplace_back("in focus, with the camera held still");
  }
  if (wrong.empty()) return {};
  return fmt::format(
      "The picture is {}, so lines may be missing, broken or in the wrong place: take it again {}.",
      fmt::join(wrong, " and "), fmt::join(advice, " and "));
}

}  // namespace palpable::vision
