// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/feature_matches.hpp"

#include "palpable/vision/image/opencv_image.hpp"
#include "palpable/vision/stereo/problem/levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// Of each left descriptor the right one that is nearest by far (Lowe's ratio), or -1.
std::vector<int> nearest(const cv::Mat& from, const cv::Mat& to) {
  constexpr float kRatio = 0.8F;
  std::vector<std::vector<cv::DMatch>> pairs;
  cv::BFMatcher(cv::NORM_L2).knnMatch(from, to, pairs, 2);
  std::vector<int> out(static_cast<std::size_t>(from.rows), -1);
  for (const auto& two : pairs)
    if (two.size() == 2 && two[0].distance < kRatio * two[1].distance)
      out[static_cast<std::size_t>(two[0].queryIdx)] = two[0].trainIdx;
  return out;
}

/// Features of very large pictures cost seconds and lie no better in the scene: these are sought in smaller
/// ones.
int shrink_factor(int width, int height) {
  constexpr int kLongest_px = 1600;
  return (std::max(width, height) + kLongest_px - 1) / kLongest_px;
}

/// The luma as 8 bits; a picture that uses few levels, as a very dark one does, is stretched: features are
/// told from grain by a fixed contrast.
cv::Mat shrunk_grey8(const Image& image, int factor) {
  constexpr float kFew = 0.4F, kMostGain = 8.0F;
  const Quantiles levels = luma_quantiles(image);
  const float low = levels[1], used = levels[kQuantiles - 2] - low;
  cv::Mat grey = grey8_of(image);
  if (used > 0.0F && used < kFew) {
    const float gain = std::min(1.0F / used, kMostGain);
    const Raster<float> luma = palpable::grey(image);
    cv::Mat(image.height, image.width, CV_32F, const_cast<float*>(luma.data()))
        .convertTo(grey, CV_8U, 255.0 * static_cast<double>(gain), -255.0 * static_cast<double>(gain * low));
  }
  if (factor > 1) cv::resize(grey, grey, {image.width / factor, image.height / factor}, 0, 0, cv::INTER_AREA);
  return grey;
}

/// Pixel centres stand at integers: the picture's corner is at -0.5.
cv::Point2d in_full(const cv::Point2f& p, int factor) {
  return {(static_cast<double>(p.x) + 0.5) * factor - 0.5, (static_cast<double>(p.y) + 0.5) * factor - 0.5};
}

}  // namespace

std::vector<FeatureMatch> match_features(const StereoPair& pair) {
  constexpr int kFeatures = 2000;
  const int factor = shrink_factor(pair.left.width, pair.left.height);
  const auto sift = cv::SIFT::create(kFeatures);
  std::vector<cv::KeyPoint> left;
  std::vector<cv::KeyPoint> right;
  cv::Mat left_descriptors;
  cv::Mat right_descriptors;
  sift->detectAndCompute(shrunk_grey8(pair.left, factor), {}, left, left_descriptors);
  sift->detectAndCompute(shrunk_grey8(pair.right, factor), {}, right, right_descriptors);
  if (left.size() < 2 || right.size() < 2) return {};
  const std::vector<int> forth = nearest(left_descriptors, right_descriptors);
  const std::vector<int> back = nearest(right_descriptors, left_descriptors);
  std::vector<FeatureMatch> out;
  for (std::size_t i = 0; i < forth.size(); ++i) {
    if (forth[i] < 0 || back[static_cast<std::size_t>(forth[i])] != static_cast<int>(i)) continue;
    const cv::Point2d p = in_full(left[i].pt, factor),
                      q = in_full(right[static_cast<std::size_t>(forth[i])].pt, factor);
    out.push_back({p.x, p.y, q.x, q.y});
  }
  return out;
}

double feature_tolerance_px(int width, int height) { return 1.5 * shrink_factor(width, height); }

double vertical_rms_px(const std::vector<FeatureMatch>& matches) {
  if (matches.empty()) return std::numeric_limits<double>::quiet_NaN();
  double squares = 0.0;
  for (const FeatureMatch& m : matches) squares += (m.left_y - m.right_y) * (m.left_y - m.right_y);
  return std::sqrt(squares / static_cast<double>(matches.size()));
}

}  // namespace palpable::vision
