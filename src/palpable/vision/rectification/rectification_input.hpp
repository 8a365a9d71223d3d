// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/vision/rectification/stereo_rectification.hpp"

#include <fmt/format.h>
#include <opencv2/core.hpp>

// Inside vision's sources only.
namespace palpable::vision {

/// Errors: usage for options out of range; invalid_input for two sizes.
inline Result<void> check_input(const StereoPair& pair, const StereoRectificationOptions& options) {
  if (auto in_range = check_ranges(options); !in_range) return in_range;
  if (pair.left.width == pair.right.width && pair.left.height == pair.right.height) return {};
  return invalid_input(
      fmt::format("the two pictures of a stereo pair must have the same size, but the left one has "
                  "{}x{} and the right one {}x{} pixels",
                  pair.left.width, pair.left.height, pair.right.width, pair.right.height));
}

/// What OpenCV says, as an error (failed).
inline Error failure(const char* what, const cv::Exception& e) {
  return {ErrorCode::failed, fmt::format("the pair could not be {}: {}", what, e.what()), {}};
}

}  // namespace palpable::vision
