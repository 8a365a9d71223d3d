// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/straight_text.hpp"

#include "palpable/vision/text/ink.hpp"
#include "palpable/vision/text/ink_coverage.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// The picture's dark lettering as black on white, whatever is behind it: grey levels 0 ... 255.
cv::Mat lettering_of(const Raster<Rgb8>& picture, const ReadTextOptions& options) {
  const auto disc = [](int k) { return cv::getStructuringElement(cv::MORPH_ELLIPSE, {k, k}); };
  const cv::Mat contrast = darkness_of(picture, options.thickest_stroke_px);
  cv::Mat strongest, out(contrast.size(), CV_8U);
  cv::dilate(contrast, strongest, disc(options.contrast_window_px));
  for (int y = 0; y < out.rows; ++y)
    for (int x = 0; x < out.cols; ++x) {
      const double part = contrast.at<std::uint8_t>(y, x) /
                          std::max<double>(options.full_contrast, strongest.at<std::uint8_t>(y, x));
      out.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(255.0 * (1.0 - part));
    }
  return out;
}

/// The part of a picture around a line, whose points become those of the part.
Raster<Rgb8> part_around(const Raster<Rgb8>& picture, TextLine& line, const ReadTextOptions& options) {
  cv::Rect2d box(line.centre.front().x, line.centre.front().y, 0.0, 0.0);
  for (const MapPoint p : line.centre) box |= cv::Rect2d(p.x, p.y, 1e-9, 1e-9);
  const double margin =
      (1.0 + options.margin) * line.height_px + options.contrast_window_px + options.thickest_stroke_px;
  const int left = std::clamp(static_cast<int>(box.x - margin), 0, picture.width() - 1);
  const int top = std::clamp(static_cast<int>(box.y - margin), 0, picture.height() - 1);
  const int right = std::clamp(static_cast<int>(box.x + box.width + margin), left, picture.width() - 1);
  const int bottom = std::clamp(static_cast<int>(box.y + box.height + margin), top, picture.height() - 1);
  Raster<Rgb8> part(right - left + 1, bottom - top + 1);
  for (int y = 0; y < part.height(); ++y)
    for (int x = 0; x < part.width(); ++x) part(x, y) = picture(left + x, top + y);
  for (MapPoint& p : line.centre) p = {p.x - left, p.y - top};
  return part;
}

int largest_difference(Rgb8 a, Rgb8 b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// Pixels in the colour of an area that is not like the lettering become white: what is left of a street
/// between the halos of its name looks like strokes otherwise.
Raster<Rgb8> with_white_ground(Raster<Rgb8> part, Rgb8 ink, const std::vector<Rgb8>& grounds,
                               const ReadTextOptions& options) {
  std::vector<Rgb8> others;
  std::copy_if(grounds.begin(), grounds.end(), std::back_inserter(others),
               [&](Rgb8 g) { return largest_difference(g, ink) >= options.ground_difference; });
  if (others.empty()) return part;
  for (Rgb8& c : part.values()) {
    int nearest = 255;
    for (const Rgb8 g : others) nearest = std::min(nearest, largest_difference(c, g));
    const double white = std::clamp(2.0 - nearest / options.ground_tolerance, 0.0, 1.0);
    const auto lightened = [white](std::uint8_t v) {
      return cv::saturate_cast<std::uint8_t>(v + white * (255 - v));
    };
    c = {lightened(c.r), lightened(c.g), lightened(c.b)};
  }
  return part;
}

/// A line of lettering, straight, upright and enlarged. Reading goes to the right, or to the left if
/// reversed.
cv::Mat straightened(const cv::Mat& picture, const TextLine& line, bool reversed, double stretch,
                     const ReadTextOptions& options) {
  const double scale = options.letter_px / std::max(options.least_height_px, line.height_px);
  const double margin = options.margin * line.height_px;
  std::vector<MapPoint> p = line.centre;
  if (reversed) std::reverse(p.begin(), p.end());
  const double length = static_cast<double>(p.size() - 1);
  const int width = static_cast<int>((length + 2.0 * margin) * scale * stretch);
  const int height = static_cast<int>((line.height_px + 2.0 * margin) * scale);
  cv::Mat map_x(height, width, CV_32F), map_y(height, width, CV_32F);
  const auto reach = static_cast<std::ptrdiff_t>(line.height_px);
  for (int x = 0; x < width; ++x) {
    const double u = x / (scale * stretch) - margin;
    const auto i = static_cast<std::ptrdiff_t>(std::clamp(u, 0.0, length));
    const auto before = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, i - reach));
    const auto after =
        static_cast<std::size_t>(std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(length), i + reach));
    const double dx = p[after].x - p[before].x;
    const double dy = p[after].y - p[before].y;
    const double n = std::max(1e-9, std::hypot(dx, dy));
    const double rest = u - static_cast<double>(i);
    const auto at = static_cast<std::size_t>(i);
    for (int y = 0; y < height; ++y) {
      const double v = y / scale - 0.5 * line.height_px - margin;
      map_x.at<float>(y, x) = static_cast<float>(p[at].x + rest * dx / n - v * dy / n);
      map_y.at<float>(y, x) = static_cast<float>(p[at].y + rest * dy / n + v * dx / n);
    }
  }
  cv::Mat out;
  cv::remap(picture, out, map_x, map_y, cv::INTER_CUBIC, cv::BORDER_CONSTANT, cv::Scalar(255));
  return out;
}

/// The grey level that a part of a picture's pixels is below.
double level_of(const cv::Mat& grey, double part) {
  std::vector<std::uint8_t> levels(grey.begin<std::uint8_t>(), grey.end<std::uint8_t>());
  const auto at = levels.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(levels.size() - 1));
  std::nth_element(levels.begin(), at, levels.end());
  return *at;
}

/// Grey levels with the ink black and the ground white.
cv::Mat with_full_contrast(const cv::Mat& grey, const ReadTextOptions& options) {
  const double dark = level_of(grey, options.ink_part), light = level_of(grey, options.ground_part);
  cv::Mat out;
  const double gain = 255.0 / std::max(1.0, light - dark);
  grey.convertTo(out, CV_8U, gain, -gain * dark);
  return out;
}

cv::Mat with_sharp_edges(const cv::Mat& grey, const ReadTextOptions& options) {
  cv::Mat blurred, out;
  cv::GaussianBlur(grey, blurred, {}, options.sharpening_radius * options.letter_px);
  cv::addWeighted(grey, 1.0 + options.sharpening, blurred, -options.sharpening, 0.0, out);
  return out;
}

cv::Mat picture_of(const Raster<Rgb8>& part, Rgb8 ink, StraightText::Kind kind,
                   const ReadTextOptions& options) {
  if (kind == StraightText::Kind::strokes) return lettering_of(part, options);
  if (kind != StraightText::Kind::covered) return luma_of(part);
  return 255 - coverage_of(part, ink, options.thickest_stroke_px, options.most_colour_difference);
}

}  // namespace

StraightText::StraightText(const Raster<Rgb8>& picture, std::span<const Rgb8> grounds,
                           const ReadTextOptions& options)
    : picture_(picture), grounds_(grounds.begin(), grounds.end()), options_(options) {}

cv::Mat StraightText::of(const TextLine& line, bool reversed, Kind kind) const {
  const double stretch = kind == Kind::stretched ? options_.stretch : 1.0;
  TextLine inside = line;
  const Raster<Rgb8> part =
      with_white_ground(part_around(picture_, inside, options_), line.colour, grounds_, options_);
  const cv::Mat seen = picture_of(part, line.colour, kind, options_);
  cv::Mat out = straightened(seen, inside, reversed, stretch, options_);
  if (kind == Kind::sharpened || kind == Kind::stretched) out = with_full_contrast(out, options_);
  if (kind == Kind::sharpened) out = with_sharp_edges(out, options_);
  if (options_.smoothing > 0.0) cv::GaussianBlur(out, out, {}, options_.smoothing * options_.letter_px);
  const int border = options_.border_px;
  cv::copyMakeBorder(out, out, border, border, 2 * border, 2 * border, cv::BORDER_CONSTANT, cv::Scalar(255));
  return out;
}

}  // namespace palpable::vision
