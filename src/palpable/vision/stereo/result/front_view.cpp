// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/result/front_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace palpable::vision {
namespace {

constexpr float kUnseen = -std::numeric_limits<float>::infinity();

/// The sample of `image` at a column between pixels, along one row.
float sample(const Image& image, double x, int y, int channel) {
  const double inside = std::clamp(x, 0.0, static_cast<double>(image.width - 1));
  const int below = std::min(static_cast<int>(inside), std::max(0, image.width - 2));
  const auto t = static_cast<float>(inside - below);
  const float a = image.pixel(below, y)[channel];
  const float b = image.pixel(std::min(below + 1, image.width - 1), y)[channel];
  return a + t * (b - a);
}

/// The left row's disparities warped to the middle view. The span between two neighbours on one surface is
/// filled, so that slanted surfaces have no gaps; the nearer surface wins.
void draw_row(std::span<const float> left_px, std::span<float> middle_px) {
  std::fill(middle_px.begin(), middle_px.end(), kUnseen);
  const auto width = static_cast<int>(left_px.size());
  const auto put = [&](int x, float d) {
    if (x < 0 || x >= width) return;
    float& there = middle_px[static_cast<std::size_t>(x)];
    there = std::max(there, d);
  };
  for (int x = 0; x < width; ++x) {
    const float d = left_px[static_cast<std::size_t>(x)];
    if (!std::isfinite(d)) continue;
    const float next = x + 1 < width ? left_px[static_cast<std::size_t>(x + 1)] : d;
    const bool same_surface = std::isfinite(next) && std::abs(next - d) <= 1.0F;
    const float from = static_cast<float>(x) - d / 2.0F;
    const float to = same_surface ? static_cast<float>(x + 1) - next / 2.0F : from + 0.5F;
    put(static_cast<int>(std::lround(from)), d);
    for (int u = static_cast<int>(std::ceil(from)); static_cast<float>(u) <= to; ++u)
      put(u, to > from ? d + (static_cast<float>(u) - from) / (to - from) * (same_surface ? next - d : 0.0F)
                       : d);
  }
}

/// Gaps get the lower disparity of their two ends.
void close_gaps(std::span<float> row) {
  std::size_t x = 0;
  while (x < row.size()) {
    if (row[x] != kUnseen) {
      ++x;
      continue;
    }
    std::size_t end = x;
    while (end < row.size() && row[end] == kUnseen) ++end;
    const float left = x > 0 ? row[x - 1] : std::numeric_limits<float>::infinity();
    const float right = end < row.size() ? row[end] : std::numeric_limits<float>::infinity();
    const float behind = std::min(left, right);
    std::fill(row.begin() + static_cast<std::ptrdiff_t>(x), row.begin() + static_cast<std::ptrdiff_t>(end),
              std::isfinite(behind) ? behind : 0.0F);
    x = end;
  }
}

/// Whether the left camera sees the point at column x of the middle view with disparity d.
bool seen_by_left(std::span<const float> left_px, double x, float d) {
  const double at = x + static_cast<double>(d) / 2.0;
  if (at < 0.0 || at > static_cast<double>(left_px.size() - 1)) return false;
  const float there = left_px[static_cast<std::size_t>(std::lround(at))];
  return std::isfinite(there) && std::abs(there - d) <= 1.0F;
}

}  // namespace

Result<FrontView> front_view(const StereoPair& pair, const Raster<float>& disparity_px, const Work& work) {
  const Image& left = pair.left;
  const Image& right = pair.right;
  const bool alike = left.width == right.width && left.height == right.height &&
                     left.channels == right.channels && left.width == disparity_px.width() &&
                     left.height == disparity_px.height();
  if (!alike) return invalid_input("a front view needs two pictures and a disparity map of the same size");
  FrontView out{{left.width, left.height, left.channels, left.bits, std::vector<float>(left.samples.size())},
                Raster<float>(left.width, left.height)};
  parallel_for(work, left.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      const auto row = out.disparity_px.row(y);
      draw_row(disparity_px.row(y), row);
      close_gaps(row);
      for (int x = 0; x < left.width; ++x) {
        const float d = row[static_cast<std::size_t>(x)];
        const double in_left = x + static_cast<double>(d) / 2.0;
        const double in_right = x - static_cast<double>(d) / 2.0;
        const bool from_left = seen_by_left(disparity_px.row(y), x, d) || in_right < 0.0;
        float* pixel = out.picture.samples.data() + (left.pixel(x, y) - left.samples.data());
        for (int c = 0; c < left.channels; ++c)
          pixel[c] = from_left ? sample(left, in_left, y, c) : sample(right, in_right, y, c);
      }
    }
  });
  if (work.cancelled()) return Work::interrupted();
  return out;
}

}  // namespace palpable::vision
