// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/problem/epipolar_pictures.hpp"

#include "palpable/core/check.hpp"
#include "palpable/vision/image/opencv_image.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

Image in_frame(const Image& image, const EpipolarFrame& frame, const Matrix3& homography) {
  const Matrix3 back = inverse(homography);
  cv::Mat from(frame.height, frame.width, CV_32FC2);
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const PicturePoint p = picture_from_frame(frame, back, {1.0 * x, 1.0 * y});
      from.at<cv::Point2f>(y, x) = {static_cast<float>(p.x), static_cast<float>(p.y)};
    }
  cv::Mat out;
  cv::remap(view_of(image), out, from, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return image_from(out, image);
}

/// From this confidence on a disparity is certain (confidence.hpp).
constexpr float kCertain = 0.9F;
/// A point this far inside the right picture was seen there with its surroundings, px.
constexpr double kInside_px = 4.0;
/// Share of the picture that certain disparities beside each other cover at least.
constexpr double kLeastIsland = 0.002;

bool is_in(const Image& picture, PicturePoint p) {
  return p.x >= kInside_px && p.y >= kInside_px && p.x <= picture.width - 1 - kInside_px &&
         p.y <= picture.height - 1 - kInside_px;
}

/// A picture that was turned onto the frame has no pixels in the frame's corners. What the right picture did
/// not see, by the nearest disparity that is certain, gets that disparity instead of one that was matched
/// there.
void fill_unseen(StereoMatch& match, const StereoPair& pair) {
  Raster<float>& disparity_px = match.disparity.disparity_px;
  const int width = disparity_px.width(), height = disparity_px.height();
  const auto seen_at = [&](int x, int y, float px) {
    return is_in(pair.right, right_point(*pair.frame, {1.0 * x, 1.0 * y}, static_cast<double>(px)));
  };
  cv::Mat uncertain(height, width, CV_8U), distance, label;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      uncertain.at<std::uint8_t>(y, x) = match.confidence(x, y) >= kCertain &&
                                                 std::isfinite(disparity_px(x, y)) &&
                                                 seen_at(x, y, disparity_px(x, y))
                                             ? 0
                                             : 255;
  // Small islands of certainty among what was not seen are chance.
  cv::Mat islands, figures, centres;
  const int count = cv::connectedComponentsWithStats(uncertain == 0, islands, figures, centres, 8);
  const double least = kLeastIsland * width * height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (const int island = islands.at<int>(y, x);
          island > 0 && island < count && figures.at<int>(island, cv::CC_STAT_AREA) < least)
        uncertain.at<std::uint8_t>(y, x) = 255;
  cv::distanceTransform(uncertain, distance, label, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  std::vector<float> certain_px(disparity_px.count() + 1, std::nanf(""));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (uncertain.at<std::uint8_t>(y, x) == 0)
        certain_px[static_cast<std::size_t>(label.at<int>(y, x))] = disparity_px(x, y);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float nearest_px = certain_px[static_cast<std::size_t>(label.at<int>(y, x))];
      if (uncertain.at<std::uint8_t>(y, x) == 0 || !std::isfinite(nearest_px) || seen_at(x, y, nearest_px))
        continue;
      disparity_px(x, y) = nearest_px;
      match.confidence(x, y) = 0.0F;
      if (!match.confirmed.empty()) match.confirmed(x, y) = 0.0F;
    }
}

/// Near the epipole a pixel of parallax is a large step of depth: the mean over a window that grows towards
/// it, of disparities within what a pixel is there.
void smooth_towards_epipole(const PolarAxes& axes, Raster<float>& disparity_px) {
  constexpr double kFull_px = 1.5;
  constexpr int kMostReach = 10;
  const Raster<float> from = disparity_px;
  for (int y = 0; y < from.height(); ++y)
    for (int x = 0; x < from.width(); ++x) {
      const double step_px =
          axes.scale_px / std::max(1.0, std::hypot(x - axes.epipole.x, y - axes.epipole.y));
      const int reach = std::min(kMostReach, static_cast<int>(kFull_px * step_px));
      double sum = 0.0, weight = 0.0;
      for (int v = std::max(0, y - reach); v <= std::min(from.height() - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min(from.width() - 1, x + reach); ++u) {
          const double value = static_cast<double>(from(u, v));
          if (!(std::abs(value - static_cast<double>(from(x, y))) <= step_px)) continue;
          sum += value;
          weight += 1.0;
        }
      if (weight > 0.0) disparity_px(x, y) = static_cast<float>(sum / weight);
    }
}

}  // namespace

StereoPair in_epipolar_frame(const StereoPair& pair) {
  PALPABLE_CHECK(pair.frame.has_value());
  const EpipolarFrame& frame = *pair.frame;
  StereoPair out;
  out.left = in_frame(pair.left, frame, frame.transform.left);
  out.right = in_frame(pair.right, frame, frame.transform.right);
  return out;
}

StereoMatch in_left_picture(StereoMatch match, const StereoPair& pair) {
  PALPABLE_CHECK(pair.frame.has_value());
  const int width = pair.left.width, height = pair.left.height;
  match.disparity.disparity_px =
      in_left_picture(*pair.frame, match.disparity.disparity_px, FrameValues::disparity, width, height);
  for (Raster<float>* map : {&match.confidence, &match.confirmed})
    *map = in_left_picture(*pair.frame, *map, FrameValues::confidence, width, height);
  fill_unseen(match, pair);
  if (pair.frame->polar) smooth_towards_epipole(*pair.frame->polar, match.disparity.disparity_px);
  match.disparity.rig = pair.rig;
  match.exchanged = false;
  return match;
}

}  // namespace palpable::vision
