// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/tracks/usable_frames.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/vision/image/opencv_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

double variance_of(const cv::Mat& values) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(values, mean, deviation);
  return deviation[0] * deviation[0];
}

// Of a picture of half the size, in which noise of single pixels counts less.
double sharpness_of(const Raster<std::uint8_t>& frame) {
  cv::Mat half, laplacian;
  cv::resize(grey_view_of(frame), half, {}, 0.5, 0.5, cv::INTER_AREA);
  cv::Laplacian(half, laplacian, CV_32F);
  return variance_of(laplacian) / std::max(1.0, variance_of(half));
}

double change_between(const Raster<std::uint8_t>& a, const Raster<std::uint8_t>& b) {
  return cv::norm(grey_view_of(a), grey_view_of(b), cv::NORM_L1) / static_cast<double>(a.count());
}

bool is_blurred(const std::vector<double>& sharpness, std::size_t frame, const UsableFrameOptions& options) {
  const auto reach = static_cast<std::size_t>(options.compared_frames);
  const std::size_t begin = frame > reach ? frame - reach : 0,
                    end = std::min(sharpness.size(), frame + reach + 1);
  std::vector<double> around(sharpness.begin() + static_cast<std::ptrdiff_t>(begin),
                             sharpness.begin() + static_cast<std::ptrdiff_t>(end));
  return sharpness[frame] < options.least_sharpness * quantile_of(around, 0.5);
}

// The grey level difference between places `step_x`, `step_y` apart that one of 200 exceeds.
int strong_difference(const Raster<std::uint8_t>& frame, int step_x, int step_y) {
  std::array<std::size_t, 256> counts{};
  for (int y = 0; y + step_y < frame.height(); ++y)
    for (int x = 0; x + step_x < frame.width(); ++x)
      ++counts[static_cast<std::size_t>(std::abs(frame(x + step_x, y + step_y) - frame(x, y)))];
  const std::size_t all = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  constexpr std::size_t kOneOf = 200;
  std::size_t above = 0;
  for (int level = 255; level > 0; --level)
    if ((above += counts[static_cast<std::size_t>(level)]) > all / kOneOf) return level;
  return 0;
}

double median_edge_width_px(std::span<const Raster<std::uint8_t>> frames, const std::vector<int>& kept) {
  std::vector<double> widths;
  for (const int i : kept) widths.push_back(edge_width_px(frames[static_cast<std::size_t>(i)]));
  return widths.empty() ? 0.0 : quantile_of(widths, 0.5);
}

}  // namespace

double edge_width_px(const Raster<std::uint8_t>& frame) {
  constexpr int kFar = 8;
  const auto width = [&](int x, int y) {
    const int near = strong_difference(frame, x, y), far = strong_difference(frame, kFar * x, kFar * y);
    return near > 0 ? std::clamp(static_cast<double>(far) / near, 1.0, static_cast<double>(kFar)) : 1.0;
  };
  return std::max(width(1, 0), width(0, 1));
}

std::vector<Parameter> parameters_of(UsableFrameOptions& o) {
  return {{"least_sharpness",
           &o.least_sharpness,
           {0, 1},
           "",
           "Less sharp frames, as a share of those around, are left out"},
          {"compared_frames",
           &o.compared_frames,
           {1, 60},
           "",
           "Frames before and after that sharpness is compared with"},
          {"least_change",
           &o.least_change,
           {0, 10},
           "",
           "Mean grey levels of 255 by which a frame differs from a copy"}};
}

Result<UsableFrames> usable_frames(std::span<const Raster<std::uint8_t>> frames,
                                   const UsableFrameOptions& options, const Work& work) {
  if (auto checked = check_ranges(options); !checked) return checked.error();
  std::vector<double> sharpness;
  for (const auto& frame : frames) {
    if (work.cancelled()) return Work::interrupted();
    sharpness.push_back(sharpness_of(frame));
  }
  UsableFrames out;
  const double sharpest_tenth = sharpness.empty() ? 0.0 : quantile_of(sharpness, 0.9);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!out.kept.empty() &&
        change_between(frames[static_cast<std::size_t>(out.kept.back())], frames[i]) < options.least_change)
      ++out.copies;
    else if (is_blurred(sharpness, i, options))
      ++out.blurred;
    else {
      out.kept.push_back(static_cast<int>(i));
      out.soft += sharpness[i] < options.least_sharpness * sharpest_tenth ? 1 : 0;
    }
  }
  out.edge_width_px = median_edge_width_px(frames, out.kept);
  return out;
}

}  // namespace palpable::vision
