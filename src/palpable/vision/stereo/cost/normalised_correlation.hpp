// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace palpable::vision {

/// A picture prepared for normalised cross-correlation over 3 x 3 windows: each window's mean and inverse
/// deviation. Border pixels are repeated. `noise_levels` is the standard deviation of pixel noise, which must
/// not count as texture; levels of 255, > 0.
class CorrelationPicture {
 public:
  CorrelationPicture(const Raster<std::uint8_t>& grey, float noise_levels)
      : values_(grey.width() + 2, grey.height() + 2), mean_(grey.width(), grey.height()), scale_(mean_) {
    const float noise = 9.0F * noise_levels * noise_levels;
    for (int y = 0; y < values_.height(); ++y)
      for (int x = 0; x < values_.width(); ++x)
        values_(x, y) = grey(std::clamp(x - 1, 0, grey.width() - 1), std::clamp(y - 1, 0, grey.height() - 1));
    for (int y = 0; y < grey.height(); ++y) {
      for (int x = 0; x < grey.width(); ++x) {
        float sum = 0.0F;
        float squares = 0.0F;
        for (int v = 0; v < 3; ++v)
          for (int u = 0; u < 3; ++u) {
            sum += values_(x + u, y + v);
            squares += values_(x + u, y + v) * values_(x + u, y + v);
          }
        mean_(x, y) = sum / 9.0F;
        scale_(x, y) = 1.0F / std::sqrt(std::max(0.0F, squares - sum * sum / 9.0F) + noise);
      }
    }
  }

  int width() const { return mean_.width(); }
  int height() const { return mean_.height(); }

  /// (1 - NCC) / 2 of the window around (x, y) in `a` and around (u, y) in `b`: 0 = equal, 1/2 = unrelated or
  /// without texture, 1 = inverted.
  friend float correlation_error(const CorrelationPicture& a, const CorrelationPicture& b, int x, int y,
                                 int u) {
    float product = 0.0F;
    for (int j = 0; j < 3; ++j) {
      const float* p = &a.values_(x, y + j);
      const float* q = &b.values_(u, y + j);
      product += p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    }
    const float covariance = product - 9.0F * a.mean_(x, y) * b.mean_(u, y);
    return 0.5F - 0.5F * covariance * a.scale_(x, y) * b.scale_(u, y);
  }

 private:
  Raster<float> values_;
  Raster<float> mean_;
  Raster<float> scale_;
};

}  // namespace palpable::vision
