// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contour_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// Scale and offset that map the 0.1st and 99.9th percentile of the colour samples to 0 and 1; identity for
/// 8-bit pictures.
std::pair<float, float> stretch_of(const Image& image) {
  if (image.bits <= 8) return {1.0F, 0.0F};
  std::vector<float> sample;
  const std::size_t step = std::max<std::size_t>(1, image.samples.size() / 200000);
  for (std::size_t i = 0; i < image.samples.size(); i += step) {
    const auto channel = static_cast<int>(i % static_cast<std::size_t>(image.channels));
    if (image.channels % 2 == 0 && channel == image.channels - 1) continue;
    sample.push_back(image.samples[i]);
  }
  const auto at = [&](double share) {
    const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(sample.size() - 1));
    std::nth_element(sample.begin(), sample.begin() + k, sample.end());
    return sample[static_cast<std::size_t>(k)];
  };
  const float low = at(0.001);
  const float high = at(0.999);
  return high > low ? std::pair{1.0F / (high - low), -low / (high - low)} : std::pair{1.0F, 0.0F};
}

/// Alpha shows white paper behind it.
float over_white(float value, float alpha) { return value * alpha + (1.0F - alpha); }

std::vector<WeightedChannel> lab_channels(cv::Mat rgb) {
  cv::Mat lab;
  cv::cvtColor(rgb, lab, cv::COLOR_RGB2Lab);
  std::vector<WeightedChannel> out;
  for (int c = 0; c < 3; ++c) {
    out.push_back({Raster<float>(lab.cols, lab.rows), c == 0 ? 1.0F : 2.0F});
    cv::Mat plane(lab.rows, lab.cols, CV_32F, out.back().values.data());
    cv::extractChannel(lab, plane, c);
    plane *= 0.01;
  }
  return out;
}

bool is_ridge(const Raster<float>& s, int x, int y, float nx, float ny) {
  const auto at = [&](float fx, float fy) {
    fx = std::clamp(fx, 0.0F, static_cast<float>(s.width() - 1));
    fy = std::clamp(fy, 0.0F, static_cast<float>(s.height() - 1));
    const int x0 = std::min(static_cast<int>(fx), s.width() - 2);
    const int y0 = std::min(static_cast<int>(fy), s.height() - 2);
    const float u = fx - static_cast<float>(x0);
    const float v = fy - static_cast<float>(y0);
    return (1 - v) * ((1 - u) * s(x0, y0) + u * s(x0 + 1, y0)) +
           v * ((1 - u) * s(x0, y0 + 1) + u * s(x0 + 1, y0 + 1));
  };
  const float here = s(x, y);
  const auto fx = static_cast<float>(x);
  const auto fy = static_cast<float>(y);
  return here >= at(fx + nx, fy + ny) && here > at(fx - nx, fy - ny);
}

}  // namespace

std::vector<WeightedChannel> edge_channels(const Image& image) {
  const auto [scale, offset] = stretch_of(image);
  const bool colour = image.channels >= 3;
  const bool alpha = image.channels % 2 == 0;
  cv::Mat values(image.height, image.width, colour ? CV_32FC3 : CV_32F);
  for (int y = 0; y < image.height; ++y) {
    auto* out = values.ptr<float>(y);
    for (int x = 0; x < image.width; ++x) {
      const float* p = image.pixel(x, y);
      const float a = alpha ? std::clamp(p[image.channels - 1], 0.0F, 1.0F) : 1.0F;
      for (int c = 0; c < (colour ? 3 : 1); ++c)
        *out++ = over_white(std::clamp(p[c] * scale + offset, 0.0F, 1.0F), a);
    }
  }
  if (colour) return lab_channels(values);
  std::vector<WeightedChannel> grey(1);
  grey[0].values = Raster<float>(image.width, image.height);
  std::copy(values.begin<float>(), values.end<float>(), grey[0].values.data());
  return grey;
}

double otsu_threshold(const Raster<float>& values) {
  constexpr int kLevels = 256;
  std::array<double, kLevels> share{};
  for (const float v : values.values()) {
    const int level = std::clamp(static_cast<int>(v * kLevels), 0, kLevels - 1);
    share[static_cast<std::size_t>(level)] += 1.0 / static_cast<double>(values.count());
  }
  double total = 0.0;
  for (int h = 0; h < kLevels; ++h) total += h * share[static_cast<std::size_t>(h)];
  double below = 0.0;
  double mean_below = 0.0;
  double best = -1.0;
  int threshold = 0;
  for (int k = 0; k < kLevels - 1; ++k) {
    below += share[static_cast<std::size_t>(k)];
    mean_below += k * share[static_cast<std::size_t>(k)];
    if (below <= 0.0 || below >= 1.0) continue;
    const double between =
        (total * below - mean_below) * (total * below - mean_below) / (below * (1.0 - below));
    if (between > best) best = between, threshold = k + 1;
  }
  return threshold / static_cast<double>(kLevels);
}

Raster<float> ridge_lines(const Raster<float>& strength, const Raster<float>& tangent_x,
                          const Raster<float>& tangent_y, double low, double high) {
  Raster<float> ridge(strength.width(), strength.height());
  std::vector<std::pair<int, int>> open;
  Raster<std::uint8_t> kept(strength.width(), strength.height());
  for (int y = 0; y < strength.height(); ++y) {
    for (int x = 0; x < strength.width(); ++x) {
      const float s = strength(x, y);
      if (s <= 0.0F || s < static_cast<float>(low)) continue;
      if (!is_ridge(strength, x, y, -tangent_y(x, y), tangent_x(x, y))) continue;
      ridge(x, y) = s;
      if (s >= static_cast<float>(high)) open.emplace_back(x, y), kept(x, y) = 1;
    }
  }
  while (!open.empty()) {
    const auto [x, y] = open.back();
    open.pop_back();
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int u = x + dx;
        const int v = y + dy;
        if (!ridge.contains(u, v) || kept(u, v) != 0 || ridge(u, v) <= 0.0F) continue;
        kept(u, v) = 1;
        open.emplace_back(u, v);
      }
    }
  }
  for (std::size_t i = 0; i < ridge.count(); ++i)
    if (kept.values()[i] == 0) ridge.values()[i] = 0.0F;
  return ridge;
}

}  // namespace palpable::vision
