// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/resample.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace palpable::sculpt {
namespace {

/// Four neighbours along one axis and their weights.
struct Taps {
  std::array<int, 4> at{};
  std::array<float, 4> weight{};
};

/// The bicubic patch of f, f_x, f_y, f_xy with central differences is a product of two cubic Hermite
/// segments, so each axis has four weights. In the printed version the vector of unknowns ends with f_yy,
/// and the bilinear formula's last term lacks a factor y - y1.
std::array<float, 4> weights(Resampling resampling, double f) {
  if (resampling == Resampling::bilinear)
    return {0.0F, static_cast<float>(1.0 - f), static_cast<float>(f), 0.0F};
  const double f2 = f * f;
  const double f3 = f2 * f;
  const double slope_before = f3 - 2.0 * f2 + f;
  const double slope_after = f3 - f2;
  return {static_cast<float>(-0.5 * slope_before),
          static_cast<float>(2.0 * f3 - 3.0 * f2 + 1.0 - 0.5 * slope_after),
          static_cast<float>(3.0 * f2 - 2.0 * f3 + 0.5 * slope_before),
          static_cast<float>(0.5 * slope_after)};
}

std::vector<Taps> taps(Resampling resampling, int from, int to) {
  std::vector<Taps> all(static_cast<std::size_t>(to));
  for (int k = 0; k < to; ++k) {
    const double place = (k + 0.5) * from / to - 0.5;
    const int cell = static_cast<int>(std::floor(place));
    Taps& t = all[static_cast<std::size_t>(k)];
    t.weight = weights(resampling, place - cell);
    for (int n = 0; n < 4; ++n) t.at[static_cast<std::size_t>(n)] = std::clamp(cell + n - 1, 0, from - 1);
  }
  return all;
}

void smooth_for(Raster<float>& values, int width, int height) {
  // A Gaussian with this share of the new spacing attenuates aliased frequencies to a tenth.
  constexpr double kShare = 0.5;
  const auto deviation = [](int from, int to) { return from > to ? kShare * from / to : 0.0; };
  const double x = deviation(values.width(), width);
  const double y = deviation(values.height(), height);
  if (x == 0.0 && y == 0.0) return;
  constexpr double kNone = 1e-3;
  cv::Mat map(values.height(), values.width(), CV_32F, values.data());
  cv::GaussianBlur(map, map, {}, std::max(x, kNone), std::max(y, kNone), cv::BORDER_REPLICATE);
}

}  // namespace

std::string_view name_of(Resampling resampling) {
  switch (resampling) {
    case Resampling::bilinear:
      return "bilinear";
    case Resampling::bicubic:
      return "bicubic";
    case Resampling::none:
      break;
  }
  return "none";
}

std::optional<Resampling> resampling_from(std::string_view name) {
  for (const Resampling r : {Resampling::none, Resampling::bilinear, Resampling::bicubic})
    if (name == name_of(r)) return r;
  return std::nullopt;
}

Raster<float> resampled(const Raster<float>& values, int width, int height, Resampling resampling) {
  PALPABLE_CHECK(width >= 2 && height >= 2 && values.width() >= 2 && values.height() >= 2);
  if (width == values.width() && height == values.height()) return values;
  PALPABLE_CHECK(resampling != Resampling::none);
  Raster<float> from = values;
  smooth_for(from, width, height);
  const auto across = taps(resampling, from.width(), width);
  const auto down = taps(resampling, from.height(), height);
  Raster<float> rows(width, from.height());
  for (int y = 0; y < from.height(); ++y)
    for (int x = 0; x < width; ++x) {
      const Taps& t = across[static_cast<std::size_t>(x)];
      rows(x, y) = t.weight[0] * from(t.at[0], y) + t.weight[1] * from(t.at[1], y) +
                   t.weight[2] * from(t.at[2], y) + t.weight[3] * from(t.at[3], y);
    }
  Raster<float> all(width, height);
  for (int y = 0; y < height; ++y) {
    const Taps& t = down[static_cast<std::size_t>(y)];
    for (int x = 0; x < width; ++x)
      all(x, y) = t.weight[0] * rows(x, t.at[0]) + t.weight[1] * rows(x, t.at[1]) +
                  t.weight[2] * rows(x, t.at[2]) + t.weight[3] * rows(x, t.at[3]);
  }
  return all;
}

}  // namespace palpable::sculpt
