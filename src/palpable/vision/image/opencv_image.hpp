// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"

#include <algorithm>

#include <opencv2/core.hpp>

// Inside vision's sources only: our pictures as OpenCV's.
namespace palpable::vision {

/// A view of the picture's samples, valid during the picture's lifetime.
inline cv::Mat view_of(const Image& image) {
  return {image.height, image.width, CV_32FC(image.channels), const_cast<float*>(image.samples.data())};
}

/// A view of grey levels; not to be written through.
inline cv::Mat grey_view_of(const Raster<std::uint8_t>& grey) {
  return {grey.height(), grey.width(), CV_8U, const_cast<std::uint8_t*>(grey.data())};
}

/// The luma as 8 bits.
inline cv::Mat grey8_of(const Image& image) {
  const Raster<float> luma = grey(image);
  cv::Mat out;
  cv::Mat(image.height, image.width, CV_32F, const_cast<float*>(luma.data())).convertTo(out, CV_8U, 255.0);
  return out;
}

/// A picture of `like`'s kind with the samples of `mat`, which has as many channels.
inline Image image_from(const cv::Mat& mat, const Image& like) {
  Image out{mat.cols, mat.rows, like.channels, like.bits, {}};
  const auto row = static_cast<std::size_t>(mat.cols) * static_cast<std::size_t>(like.channels);
  out.samples.resize(row * static_cast<std::size_t>(mat.rows));
  for (int y = 0; y < mat.rows; ++y)
    std::copy_n(mat.ptr<float>(y), row, out.samples.begin() + static_cast<std::ptrdiff_t>(row) * y);
  return out;
}

}  // namespace palpable::vision
