// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/line_extension.hpp"

#include "palpable/vision/text/ink.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <opencv2/core.hpp>

namespace palpable::vision {
namespace {

/// The ink behind an end of a line.
class InkBehind {
 public:
  InkBehind(const Raster<Rgb8>& picture, const cv::Mat& darkness, const TextLine& line, bool last,
            const LineExtensionOptions& options)
      : picture_(picture), darkness_(darkness), line_(line), options_(options) {
    const auto& p = line.centre;
    const std::size_t back = std::min(p.size() - 1, static_cast<std::size_t>(2.0 * line.height_px));
    end_ = last ? p.back() : p.front();
    const MapPoint inner = last ? p[p.size() - 1 - back] : p[back];
    const double n = std::max(1e-9, std::hypot(end_.x - inner.x, end_.y - inner.y));
    out_ = {(end_.x - inner.x) / n, (end_.y - inner.y) / n};
  }

  /// How far lettering goes on, whole pixels; 0 if it does not, or without an end, as a border beside it
  /// does.
  int length() const {
    const double height = line_.height_px;
    const int most = static_cast<int>(options_.most_length * height);
    const int gap = static_cast<int>(std::ceil(options_.most_gap * height));
    int last = 0;
    for (int u = 1; u <= most + gap && u <= last + gap; ++u) {
      if (is_border(u)) break;
      if (has_ink(u)) last = u;
    }
    return last >= options_.least_length * height && last <= most ? last : 0;
  }

  MapPoint at(int u) const { return {end_.x + u * out_.x, end_.y + u * out_.y}; }

 private:
  bool is_ink(int u, double v) const {
    const int x = static_cast<int>(std::lround(end_.x + u * out_.x - v * out_.y));
    const int y = static_cast<int>(std::lround(end_.y + u * out_.y + v * out_.x));
    if (!picture_.contains(x, y) || darkness_.at<std::uint8_t>(y, x) < options_.contrast) return false;
    const Rgb8 c = picture_(x, y);
    return std::sqrt(std::pow(c.r - line_.colour.r, 2.0) + std::pow(c.g - line_.colour.g, 2.0) +
                     std::pow(c.b - line_.colour.b, 2.0)) <= options_.most_colour_difference;
  }
  bool has_ink(int u) const {
    const double half = 0.5 * line_.height_px;
    for (double v = -half; v <= half; v += 1.0)
      if (is_ink(u, v)) return true;
    return false;
  }
  bool is_border(int u) const {
    const double half = 0.5 * line_.height_px;
    for (const double side : {-1.0, 1.0})
      for (int k = 1; k <= options_.beyond_px; ++k)
        if (!is_ink(u, side * (half + k))) return false;
    return true;
  }

  const Raster<Rgb8>& picture_;
  const cv::Mat& darkness_;
  const TextLine& line_;
  LineExtensionOptions options_;
  MapPoint end_;
  MapPoint out_;
};

}  // namespace

std::vector<Parameter> parameters_of(LineExtensionOptions& o) {
  return {{"most_colour_difference", &o.most_colour_difference, {0, 442}, "levels", "from the line's ink"},
          {"contrast", &o.contrast, {1, 255}, "levels", "least contrast of ink"},
          {"most_gap", &o.most_gap, {0, 5}, "heights", "largest gap before the next letter or word"},
          {"most_length", &o.most_length, {0, 50}, "heights", "farthest that a line goes on"},
          {"beyond_px", &o.beyond_px, {1, 20}, "px", "how far a border reaches beyond both sides"},
          {"least_length", &o.least_length, {0, 5}, "heights", "least length that is added"}};
}

std::vector<TextLine> extended_lines(const Raster<Rgb8>& picture, std::span<const TextLine> lines,
                                     int thickest_stroke_px, const LineExtensionOptions& options) {
  const cv::Mat darkness = darkness_of(picture, thickest_stroke_px);
  std::vector<TextLine> out;
  for (const TextLine& line : lines) {
    if (line.centre.size() < 2) continue;
    const InkBehind first(picture, darkness, line, false, options),
        last(picture, darkness, line, true, options);
    const int before = first.length(), after = last.length();
    if (before + after == 0) continue;
    TextLine longer = line;
    longer.letters += 1;
    longer.centre.clear();
    for (int u = before; u > 0; --u) longer.centre.push_back(first.at(u));
    longer.centre.insert(longer.centre.end(), line.centre.begin(), line.centre.end());
    for (int u = 1; u <= after; ++u) longer.centre.push_back(last.at(u));
    out.push_back(std::move(longer));
  }
  return out;
}

}  // namespace palpable::vision
