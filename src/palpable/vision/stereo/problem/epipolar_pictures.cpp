// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/problem/epipolar_pictures.hpp"

#include "palpable/core/check.hpp"
#include "palpable/vision/image/opencv_image.hpp"

#include <utility>

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
  match.exchanged = false;
  return match;
}

}  // namespace palpable::vision
