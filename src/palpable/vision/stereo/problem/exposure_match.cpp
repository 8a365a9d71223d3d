// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/problem/exposure_match.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/format.h>

namespace palpable::vision {
namespace {

constexpr std::size_t kLast = kQuantiles - 1;
constexpr std::size_t kMiddle = kQuantiles / 2;

/// The number of quantiles at the brightest level, without the extreme one; and at the darkest.
std::size_t at_the_top(const Quantiles& q) {
  return static_cast<std::size_t>(std::count(q.begin(), q.end(), q[kLast])) - 1;
}
std::size_t at_the_bottom(const Quantiles& q) {
  return static_cast<std::size_t>(std::count(q.begin(), q.end(), q[0])) - 1;
}

/// The quantiles of `level(pixel)` over a sample of evenly spread pixels, which suffices for 256 quantiles.
template <class Level>
Quantiles quantiles_over(const Image& image, const Level& level) {
  constexpr std::size_t kSample = 8192;
  const auto width = static_cast<std::size_t>(image.width);
  const std::size_t pixels = width * static_cast<std::size_t>(image.height);
  std::size_t step = std::max<std::size_t>(1, pixels / kSample);
  // A step that is coprime to the width visits every column.
  while (std::gcd(step, width) != 1) ++step;
  std::vector<float> values;
  values.reserve(pixels / step + 1);
  for (std::size_t i = 0; i < pixels; i += step) {
    const float v = level(image.samples.data() + i * static_cast<std::size_t>(image.channels));
    if (std::isfinite(v)) values.push_back(v);
  }
  Quantiles out{};
  if (values.empty()) return out;
  std::sort(values.begin(), values.end());
  for (std::size_t q = 0; q < kQuantiles; ++q) out[q] = values[(values.size() - 1) * q / kLast];
  return out;
}

Quantiles channel_quantiles(const Image& image, int channel) {
  return quantiles_over(image, [channel](const float* pixel) { return pixel[channel]; });
}

/// The middle part of the histograms.
struct ComparedPart {
  std::size_t first, last;
};

double mean_difference(const Quantiles& left, const Quantiles& right, ComparedPart part) {
  double sum = 0.0;
  for (std::size_t q = part.first; q <= part.last; ++q)
    sum += static_cast<double>(std::abs(left[q] - right[q]));
  return sum / static_cast<double>(part.last - part.first + 1);
}

}  // namespace

Quantiles luma_quantiles(const Image& image) {
  const int g = image.channels >= 3 ? 1 : 0, b = image.channels >= 3 ? 2 : 0;
  return quantiles_over(image, [g, b](const float* pixel) {
    return 0.299F * pixel[0] + 0.587F * pixel[g] + 0.114F * pixel[b];
  });
}

LevelCurve::LevelCurve(const Quantiles& from, const Quantiles& to, int clipped_quantiles)
    : identity_(false), from_(from), to_(to) {
  const auto clipped = static_cast<std::size_t>(clipped_quantiles);
  if (at_the_top(from) >= clipped + at_the_top(to)) most_ = to[kLast - at_the_top(from)];
  if (at_the_bottom(from) >= clipped + at_the_bottom(to)) least_ = to[at_the_bottom(from)];
}

float LevelCurve::operator()(float level) const {
  if (identity_) return level;
  // Beyond its ends the curve continues with slope 1.
  if (level < from_.front()) return clip(to_.front() + (level - from_.front()));
  if (level > from_.back()) return clip(to_.back() + (level - from_.back()));
  const auto [first, past] = std::equal_range(from_.begin(), from_.end(), level);
  const auto i = static_cast<std::size_t>(first - from_.begin()),
             j = static_cast<std::size_t>(past - from_.begin());
  // A level shared by many pixels is mapped to the middle of its range.
  if (i < j) return clip(to_[(i + j - 1) / 2]);
  const float t = (level - from_[i - 1]) / (from_[i] - from_[i - 1]);
  return clip(to_[i - 1] + t * (to_[i] - to_[i - 1]));
}

std::vector<Parameter> parameters_of(PreparationOptions& o) {
  return {{"exposure_difference",
           &o.exposure_difference,
           {0, 1},
           "",
           "Difference of the histograms that is corrected"},
          {"compared_first", &o.compared_first, {0, 127}, "", "First of 256 quantiles that are compared"},
          {"compared_last", &o.compared_last, {128, 255}, "", "Last of 256 quantiles that are compared"},
          {"clipped_quantiles", &o.clipped_quantiles, {1, 128}, "", "Quantiles at one end if it is clipped"},
          {"stretch_below",
           &o.stretch_below,
           {0, 1},
           "",
           "8-bit pictures that use less of their levels are stretched"},
          {"frame_darkness",
           &o.frame_darkness,
           {0, 1},
           "",
           "A frame's line is darker than its neighbour by this factor"},
          {"frame_divisor", &o.frame_divisor, {2, 1000}, "", "A frame takes at most a side over this"}};
}

ExposureMatch match_exposures(const Image& left, const Image& right, const PreparationOptions& options) {
  ExposureMatch out;
  const int colours = std::min(left.channels, right.channels) >= 3 ? 3 : 1;
  const ComparedPart part{static_cast<std::size_t>(options.compared_first),
                          static_cast<std::size_t>(options.compared_last)};
  std::array<Quantiles, 3> of_left{}, of_right{};
  double difference = 0.0, used = 0.0, middle_left = 0.0, middle_right = 0.0;
  for (int c = 0; c < colours; ++c) {
    const auto i = static_cast<std::size_t>(c);
    of_left[i] = channel_quantiles(left, c);
    of_right[i] = channel_quantiles(right, c);
    difference += mean_difference(of_left[i], of_right[i], part);
    used += static_cast<double>(std::max(of_left[i][part.last] - of_left[i][part.first],
                                         of_right[i][part.last] - of_right[i][part.first]));
    middle_left += static_cast<double>(of_left[i][kMiddle]);
    middle_right += static_cast<double>(of_right[i][kMiddle]);
    out.exposure.left_clipped =
        std::max(out.exposure.left_clipped, static_cast<double>(at_the_top(of_left[i])) / kLast);
    out.exposure.right_clipped =
        std::max(out.exposure.right_clipped, static_cast<double>(at_the_top(of_right[i])) / kLast);
  }
  out.exposure.brightness_ratio = middle_left > 0.0 ? middle_right / middle_left : 1.0;
  out.exposure.differs = difference > options.exposure_difference * used;
  if (!out.exposure.differs) return out;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t i = std::min<std::size_t>(c, static_cast<std::size_t>(colours) - 1);
    out.curves[c] = LevelCurve(of_right[i], of_left[i], options.clipped_quantiles);
  }
  return out;
}

std::string sentence_of(const Exposure& exposure) {
  constexpr double kWorthSaying = 0.02;
  const double clipped = std::max(exposure.left_clipped, exposure.right_clipped);
  const std::string lost =
      clipped < kWorthSaying
          ? ""
          : fmt::format(
                " {:.0f} % of the {} one is burnt out, where no depth can be seen: give both the same "
                "exposure.",
                100.0 * clipped, exposure.right_clipped >= exposure.left_clipped ? "right" : "left");
  return fmt::format(
      "The pictures were exposed differently: the right one is {:.2f} times as bright as the left one, and "
      "its "
      "levels were matched to the left one's.{}",
      exposure.brightness_ratio, lost);
}

}  // namespace palpable::vision
