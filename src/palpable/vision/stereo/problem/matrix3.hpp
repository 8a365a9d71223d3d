// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/rectifying_transform.hpp"

#include <algorithm>

#include <opencv2/core.hpp>

// Inside vision's sources only.
namespace palpable::vision {

inline Matrix3 array_of(const cv::Matx33d& m) {
  Matrix3 out{};
  std::copy_n(m.val, out.size(), out.begin());
  return out;
}

}  // namespace palpable::vision
