// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"

#include <cmath>

#include <opencv2/core.hpp>

namespace palpable::vision {

/// Maps pixels to places in half diagonals from the picture's middle, for well-conditioned products of
/// coordinates.
inline cv::Matx33d half_diagonals_from_pixels(const Image& picture) {
  const double s = 2.0 / std::hypot(picture.width, picture.height);
  return {s, 0, -s * 0.5 * (picture.width - 1), 0, s, -s * 0.5 * (picture.height - 1), 0, 0, 1};
}

}  // namespace palpable::vision
