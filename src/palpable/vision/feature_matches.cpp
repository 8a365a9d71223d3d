// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/feature_matches.hpp"

#include "palpable/vision/opencv_image.hpp"

#include <cmath>
#include <limits>

#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>

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

}  // namespace

std::vector<FeatureMatch> match_features(const StereoPair& pair) {
  constexpr int kFeatures = 2000;
  constexpr double kInlier_px = 1.5;
  const auto sift = cv::SIFT::create(kFeatures);
  std::vector<cv::KeyPoint> left;
  std::vector<cv::KeyPoint> right;
  cv::Mat left_descriptors;
  cv::Mat right_descriptors;
  sift->detectAndCompute(grey8_of(pair.left), {}, left, left_descriptors);
  sift->detectAndCompute(grey8_of(pair.right), {}, right, right_descriptors);
  if (left.size() < 8 || right.size() < 8) return {};
  const std::vector<int> forth = nearest(left_descriptors, right_descriptors);
  const std::vector<int> back = nearest(right_descriptors, left_descriptors);
  std::vector<cv::Point2d> p;
  std::vector<cv::Point2d> q;
  for (std::size_t i = 0; i < forth.size(); ++i) {
    if (forth[i] < 0 || back[static_cast<std::size_t>(forth[i])] != static_cast<int>(i)) continue;
    p.emplace_back(left[i].pt);
    q.emplace_back(right[static_cast<std::size_t>(forth[i])].pt);
  }
  if (p.size() < 8) return {};
  cv::setRNGSeed(1);
  cv::Mat kept;
  const cv::Mat fundamental = cv::findFundamentalMat(p, q, cv::FM_RANSAC, kInlier_px, 0.999, kept);
  if (fundamental.empty()) return {};
  std::vector<FeatureMatch> out;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (kept.at<std::uint8_t>(static_cast<int>(i)) != 0) out.push_back({p[i].x, p[i].y, q[i].x, q[i].y});
  return out.size() < 8 ? std::vector<FeatureMatch>{} : out;
}

double vertical_rms_px(const std::vector<FeatureMatch>& matches) {
  if (matches.empty()) return std::numeric_limits<double>::quiet_NaN();
  double squares = 0.0;
  for (const FeatureMatch& m : matches) squares += (m.left_y - m.right_y) * (m.left_y - m.right_y);
  return std::sqrt(squares / static_cast<double>(matches.size()));
}

}  // namespace palpable::vision
