// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/image/reduced_picture.hpp"

#include "palpable/vision/image/opencv_image.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {

std::optional<Image> reduced(const Image& image, std::size_t most_pixels) {
  const double pixels = static_cast<double>(image.width) * image.height;
  if (pixels <= static_cast<double>(most_pixels)) return std::nullopt;
  const double share = std::sqrt(static_cast<double>(most_pixels) / pixels);
  const auto side = [share](int of) { return std::max(1, static_cast<int>(share * of)); };
  Image out{side(image.width), side(image.height), image.channels, image.bits, {}};
  out.samples.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height) *
                     static_cast<std::size_t>(out.channels));
  cv::Mat target(out.height, out.width, CV_MAKETYPE(CV_32F, out.channels), out.samples.data());
  cv::resize(view_of(image), target, target.size(), 0, 0, cv::INTER_AREA);
  return out;
}

}  // namespace palpable::vision
