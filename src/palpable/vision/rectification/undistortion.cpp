// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/undistortion.hpp"

#include <utility>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {

Result<void> undistort(std::span<Raster<Rgb8>* const> pictures, const LensCamera& camera, const Work& work) {
  if (pictures.empty()) return {};
  const cv::Size size(pictures.front()->width(), pictures.front()->height());
  for (const auto* picture : pictures)
    if (picture->width() != size.width || picture->height() != size.height)
      return invalid_input("the frames of a video must have one size");
  const cv::Matx33d matrix(camera.matrix.data());
  cv::Mat from, weights;
  cv::initUndistortRectifyMap(matrix, camera.distortion, cv::noArray(), matrix, size, CV_16SC2, from,
                              weights);
  parallel_for(work, static_cast<int>(pictures.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end && !work.cancelled(); ++i) {
      Raster<Rgb8>& picture = *pictures[static_cast<std::size_t>(i)];
      Raster<Rgb8> out(size.width, size.height);
      const cv::Mat before(size, CV_8UC3, picture.data());
      cv::Mat after(size, CV_8UC3, out.data());
      cv::remap(before, after, from, weights, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
      picture = std::move(out);
    }
  });
  return work.cancelled() ? Result<void>(Work::interrupted()) : Result<void>();
}

}  // namespace palpable::vision
