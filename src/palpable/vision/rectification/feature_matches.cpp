// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/feature_matches.hpp"

#include "palpable/vision/image/opencv_image.hpp"
#include "palpable/vision/stereo/problem/exposure_match.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// For each left descriptor the nearest right one if it passes Lowe's ratio test, else -1.
std::vector<int> nearest(const cv::Mat& from, const cv::Mat& to, float ratio) {
  std::vector<std::vector<cv::DMatch>> pairs;
  cv::BFMatcher(cv::NORM_L2).knnMatch(from, to, pairs, 2);
  std::vector<int> out(static_cast<std::size_t>(from.rows), -1);
  for (const auto& two : pairs)
    if (two.size() == 2 && two[0].distance < ratio * two[1].distance)
      out[static_cast<std::size_t>(two[0].queryIdx)] = two[0].trainIdx;
  return out;
}

/// In very large pictures features cost seconds and are no more accurate in the scene.
int shrink_factor(int width, int height, int longest_px) {
  return (std::max(width, height) + longest_px - 1) / longest_px;
}

/// The luma as 8 bits. A picture that uses few levels, such as a very dark one, is stretched, since the
/// detector's contrast threshold is fixed.
cv::Mat shrunk_grey8(const Image& image, int factor, const FeatureMatchOptions& options) {
  const auto few = static_cast<float>(options.few_levels), most_gain = static_cast<float>(options.most_gain);
  const Quantiles levels = luma_quantiles(image);
  const float low = levels[1], used = levels[kQuantiles - 2] - low;
  cv::Mat grey = grey8_of(image);
  if (used > 0.0F && used < few) {
    const float gain = std::min(1.0F / used, most_gain);
    const Raster<float> luma = palpable::grey(image);
    cv::Mat(image.height, image.width, CV_32F, const_cast<float*>(luma.data()))
        .convertTo(grey, CV_8U, 255.0 * static_cast<double>(gain), -255.0 * static_cast<double>(gain * low));
  }
  if (factor > 1) cv::resize(grey, grey, {image.width / factor, image.height / factor}, 0, 0, cv::INTER_AREA);
  return grey;
}

/// Pixel centres are at integers, so the picture's corner is at -0.5.
cv::Point2d in_full(const cv::Point2f& p, int factor) {
  return {(static_cast<double>(p.x) + 0.5) * factor - 0.5, (static_cast<double>(p.y) + 0.5) * factor - 0.5};
}

}  // namespace

std::vector<FeatureMatch> match_features(const StereoPair& pair, const FeatureMatchOptions& options) {
  const int factor = shrink_factor(pair.left.width, pair.left.height, options.longest_px);
  const auto sift = cv::SIFT::create(options.most_features);
  std::vector<cv::KeyPoint> left;
  std::vector<cv::KeyPoint> right;
  cv::Mat left_descriptors;
  cv::Mat right_descriptors;
  sift->detectAndCompute(shrunk_grey8(pair.left, factor, options), {}, left, left_descriptors);
  sift->detectAndCompute(shrunk_grey8(pair.right, factor, options), {}, right, right_descriptors);
  if (left.size() < 2 || right.size() < 2) return {};
  const auto ratio = static_cast<float>(options.ratio);
  const std::vector<int> forth = nearest(left_descriptors, right_descriptors, ratio);
  const std::vector<int> back = nearest(right_descriptors, left_descriptors, ratio);
  std::vector<FeatureMatch> out;
  for (std::size_t i = 0; i < forth.size(); ++i) {
    if (forth[i] < 0 || back[static_cast<std::size_t>(forth[i])] != static_cast<int>(i)) continue;
    const cv::Point2d p = in_full(left[i].pt, factor),
                      q = in_full(right[static_cast<std::size_t>(forth[i])].pt, factor);
    out.push_back({p.x, p.y, q.x, q.y});
  }
  return out;
}

double feature_tolerance_px(int width, int height, const FeatureMatchOptions& options) {
  return options.tolerance_px * shrink_factor(width, height, options.longest_px);
}

double vertical_rms_px(const std::vector<FeatureMatch>& matches) {
  if (matches.empty()) return std::numeric_limits<double>::quiet_NaN();
  double squares = 0.0;
  for (const FeatureMatch& m : matches) squares += (m.left_y - m.right_y) * (m.left_y - m.right_y);
  return std::sqrt(squares / static_cast<double>(matches.size()));
}

}  // namespace palpable::vision
