// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/problem/rectifying_transform.hpp"

#include "palpable/vision/stereo/problem/matrix3.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

namespace palpable::vision {
PicturePoint rectified_point(const RectifyingTransform& by, const Matrix3& homography, PicturePoint place) {
  if (by.distortion != 0.0) {
    const double x = place.x - by.cx, y = place.y - by.cy,
                 scale = 1.0 / (1.0 + by.distortion * (x * x + y * y));
    place = {by.cx + scale * x, by.cy + scale * y};
  }
  return mapped(homography, place);
}

PicturePoint source_point(const RectifyingTransform& by, const Matrix3& inverse_homography,
                          PicturePoint place) {
  const PicturePoint u = mapped(inverse_homography, place);
  const double x = u.x - by.cx, y = u.y - by.cy, squared = x * x + y * y;
  if (by.distortion == 0.0 || squared == 0.0) return u;
  // r = (1 - √(1 - 4 k u²)) / (2 k u) solves u = r / (1 + k r²); beyond the root there is no solution.
  const double root = std::sqrt(std::max(0.0, 1.0 - 4.0 * by.distortion * squared));
  const double scale = 2.0 / (1.0 + root);
  return {by.cx + scale * x, by.cy + scale * y};
}

PicturePoint mapped(const Matrix3& h, PicturePoint p) {
  const double w = h[6] * p.x + h[7] * p.y + h[8];
  return {(h[0] * p.x + h[1] * p.y + h[2]) / w, (h[3] * p.x + h[4] * p.y + h[5]) / w};
}

Matrix3 product(const Matrix3& a, const Matrix3& b) {
  return array_of(cv::Matx33d(a.data()) * cv::Matx33d(b.data()));
}

Matrix3 inverse(const Matrix3& m) { return array_of(cv::Matx33d(m.data()).inv()); }

}  // namespace palpable::vision
