// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/border_distance.hpp"

#include <opencv2/imgproc.hpp>

namespace palpable::vision {

cv::Mat border_distance(const Raster<std::uint8_t>& mask) {
  // OpenCV does not write into its source.
  const cv::Mat view(mask.height(), mask.width(), CV_8U, const_cast<std::uint8_t*>(mask.data()));
  cv::Mat distance;
  cv::distanceTransform(view, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance;
}

}  // namespace palpable::vision
