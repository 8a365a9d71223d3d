// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace palpable::vision {

/// The image of a plane in disparity space: disparity = a x + b y + c, pixels.
struct DisparityPlane {
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;
  double at(double x, double y) const { return a * x + b * y + c; }
};

}  // namespace palpable::vision
