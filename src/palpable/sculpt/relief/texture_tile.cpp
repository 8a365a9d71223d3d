// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/texture_tile.hpp"

#include "palpable/models/material/touch_texture.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace palpable::sculpt {
namespace {

constexpr int kSide = models::kTextureSide;
constexpr double kTurn = 2.0 * std::numbers::pi;
/// Least z of a normal: steeper slopes are errors of the normal map.
constexpr double kFlattest = 0.05;

/// One channel of the picture, or a combination, at the tile's size.
template <class Value>
cv::Mat at_tile_size(const Image& picture, const Value& value) {
  cv::Mat whole(picture.height, picture.width, CV_64F);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) whole.at<double>(y, x) = value(picture.pixel(x, y));
  cv::Mat out;
  cv::resize(whole, out, {kSide, kSide}, 0, 0,
             std::min(whole.cols, whole.rows) >= kSide ? cv::INTER_AREA : cv::INTER_CUBIC);
  return out;
}

cv::Mat spectrum_of(const cv::Mat& values) {
  cv::Mat out;
  cv::dft(values, out, cv::DFT_COMPLEX_OUTPUT);
  return out;
}

/// The frequency, in waves per side, at an index of a spectrum; negative in its later half.
int waves_at(int index) { return index <= kSide / 2 ? index : index - kSide; }

/// The attenuation of a frequency by the sampled cubic B-spline.
double spline_response(int waves) { return (2.0 + std::cos(kTurn * waves / kSide)) / 3.0; }

/// Calls f(value, waves to the right, waves down) for every wave of a spectrum.
template <class F>
void each_wave(cv::Mat& spectrum, const F& f) {
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) f(spectrum.at<std::complex<double>>(j, i), waves_at(i), waves_at(j));
}

cv::Mat heights_from_slopes(const Image& picture) {
  const auto slope = [](float part, const float* p) {
    return -(2.0 * static_cast<double>(part) - 1.0) /
           std::max(kFlattest, 2.0 * static_cast<double>(p[2]) - 1.0);
  };
  // y up in the map, down in the picture.
  cv::Mat right = spectrum_of(at_tile_size(picture, [&](const float* p) { return slope(p[0], p); }));
  cv::Mat down = spectrum_of(at_tile_size(picture, [&](const float* p) { return -slope(p[1], p); }));
  each_wave(right, [&](std::complex<double>& value, int u, int v) {
    const double length2 = u * u + v * v;
    const std::complex<double> there =
        down.at<std::complex<double>>((v + kSide) % kSide, (u + kSide) % kSide);
    value = length2 > 0.0 ? std::complex<double>(0.0, -1.0) *
                                (static_cast<double>(u) * value + static_cast<double>(v) * there) / length2
                          : 0.0;
  });
  return right;
}

/// The greatest of the values, and of their second differences in units of the finest wave's.
double greatest_of(const cv::Mat& values) {
  const double finest = std::pow(kTurn * models::kPictureForms / kSide, 2);
  double greatest = 0.0;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const auto at = [&](int x, int y) {
        return values.at<double>((y + kSide) % kSide, (x + kSide) % kSide);
      };
      const double here = at(i, j);
      const double across = std::abs(at(i - 1, j) - 2.0 * here + at(i + 1, j));
      const double along = std::abs(at(i, j - 1) - 2.0 * here + at(i, j + 1));
      greatest = std::max({greatest, std::abs(here), across / finest, along / finest});
    }
  return greatest;
}

}  // namespace

bool is_normal_map(const Image& picture) {
  if (picture.channels < 3) return false;
  std::size_t unit = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const float* p = picture.pixel(x, y);
      const double nx = 2.0 * static_cast<double>(p[0]) - 1.0, ny = 2.0 * static_cast<double>(p[1]) - 1.0,
                   nz = 2.0 * static_cast<double>(p[2]) - 1.0;
      if (nz > 0.0 && std::abs(std::sqrt(nx * nx + ny * ny + nz * nz) - 1.0) < 0.1) ++unit;
    }
  return static_cast<double>(unit) >= 0.95 * picture.width * picture.height;
}

Result<std::vector<float>> texture_tile(const Image& picture) {
  if (picture.width < 8 || picture.height < 8)
    return invalid_input("a texture's picture is at least 8 x 8 pixels large");
  if (!std::all_of(picture.samples.begin(), picture.samples.end(), [](float v) { return std::isfinite(v); }))
    return invalid_input("the texture's picture has samples that are not finite numbers");
  const bool colour = picture.channels >= 3;
  cv::Mat spectrum = is_normal_map(picture) ? heights_from_slopes(picture)
                                            : spectrum_of(at_tile_size(picture, [colour](const float* p) {
                                                return colour ? 0.299 * static_cast<double>(p[0]) +
                                                                    0.587 * static_cast<double>(p[1]) +
                                                                    0.114 * static_cast<double>(p[2])
                                                              : static_cast<double>(p[0]);
                                              }));
  each_wave(spectrum, [](std::complex<double>& value, int u, int v) {
    const bool kept = (u != 0 || v != 0) && std::hypot(u, v) <= models::kPictureForms;
    value = kept ? value / (spline_response(u) * spline_response(v)) : 0.0;
  });
  cv::Mat values;
  cv::dft(spectrum, values, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  const double greatest = greatest_of(values);
  // Less than a tenth of a grey level of 8 bits.
  if (!(greatest > 4e-4))
    return invalid_input("the texture's picture is of one tone: there is nothing to feel");
  std::vector<float> tile;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) tile.push_back(static_cast<float>(values.at<double>(j, i) / greatest));
  return tile;
}

}  // namespace palpable::sculpt
