// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/carriageways.hpp"

#include "palpable/vision/streets/lines/border_distance.hpp"
#include "palpable/vision/streets/lines/carriageway_sides.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

using Width = MeasuredRadius;

/// Radii of the lines of nearly constant width, with their lengths.
std::vector<Width> widths_of(const CentreLines& graph, const CarriagewayOptions& options) {
  std::vector<Width> out;
  for (const CentreLine& line : graph.lines)
    if (const double length = length_px(line.points);
        length > options.measured_widths * 2.0 * line.radius_px &&
        line.radius_spread_px < options.measured_spread * line.radius_px)
      out.push_back({line.radius_px, length});
  return out;
}

double length_of(const std::vector<Width>& widths) {
  return std::accumulate(widths.begin(), widths.end(), 0.0,
                         [](double sum, const Width& w) { return sum + w.length; });
}

/// The widest single carriageway among common radii; 0 if there are none. The main colour shows streets of
/// several kinds.
double single_radius(std::vector<double> radii, bool is_main, const CarriagewayOptions& options) {
  double single = radii.empty() ? 0.0 : radii.front();
  std::sort(radii.begin(), radii.end());
  // Of a colour with two carriageways nearly everywhere, the narrower width is the single one, unless there
  // are streets that are too wide for two of it: then it is that of slip roads.
  const auto narrower = std::find_if(radii.begin(), radii.end(), [&](double radius) {
    return single > options.next_width * radius && radii.back() <= options.most_widths * radius;
  });
  if (!is_main && narrower != radii.end()) single = *narrower;
  const double most = options.next_width * single;
  for (const double radius : radii)
    if (radius > single && radius <= most) single = radius;
  return single;
}

cv::Mat disc(double radius) {
  const int side = 2 * static_cast<int>(std::lround(radius)) + 1;
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side});
}

/// Without the pieces whose box has a diagonal below `least_px`.
void remove_short_pieces(cv::Mat& mask, double least_px) {
  cv::Mat labels, stats, centres;
  const int n = cv::connectedComponentsWithStats(mask, labels, stats, centres, 8);
  for (int i = 1; i < n; ++i)
    if (std::hypot(stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT)) < least_px) {
      const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                         stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
      mask(box).setTo(0, labels(box) == i);
    }
}

}  // namespace

std::vector<double> common_radii(std::vector<MeasuredRadius> widths, const CarriagewayOptions& options) {
  const double all = length_of(widths);
  std::vector<double> out;
  while (!widths.empty()) {
    Width best;
    for (const Width& middle : widths) {
      Width sum;
      for (const Width& w : widths)
        if (std::abs(w.radius - middle.radius) <= options.same_width * middle.radius) {
          sum.radius += w.length * w.radius;
          sum.length += w.length;
        }
      if (sum.length > best.length) best = {sum.radius / sum.length, sum.length};
    }
    if (best.length == 0.0) break;
    if (best.length >= std::min(options.common_part * all, options.common_widths * 2.0 * best.radius))
      out.push_back(best.radius);
    std::erase_if(widths, [&](const Width& w) {
      return std::abs(w.radius - best.radius) <= 2.0 * options.same_width * best.radius;
    });
  }
  return out;
}

std::vector<double> carriageway_radii(std::span<const CentreLines* const> colours,
                                      const CarriagewayOptions& options) {
  std::vector<double> radii, lengths;
  std::vector<std::vector<double>> common;
  if (colours.empty()) return radii;
  for (const CentreLines* graph : colours) {
    std::vector<Width> widths = widths_of(*graph, options);
    lengths.push_back(length_of(widths));
    common.push_back(common_radii(std::move(widths), options));
  }
  const double most = *std::max_element(lengths.begin(), lengths.end());
  for (std::size_t c = 0; c < common.size(); ++c)
    radii.push_back(single_radius(common[c], lengths[c] == most, options));
  const double all = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  std::vector<double> out = radii;
  for (std::size_t c = 0; c < radii.size(); ++c) {
    double widest_other = 0.0;
    for (std::size_t k = 0; k < radii.size(); ++k)
      if (k != c && lengths[k] >= options.common_part * all) widest_other = std::max(widest_other, radii[k]);
    if (widest_other > 0.0 && radii[c] >= options.width_ratio * widest_other)
      out[c] = std::max(widest_other, 0.5 * radii[c]);
  }
  return out;
}

ThinningGuide carriageways_in(const Raster<std::uint8_t>& mask, double radius_px,
                              const CarriagewayOptions& options) {
  if (radius_px <= 0.0)
    return {Raster<std::uint8_t>(mask.width(), mask.height()),
            Raster<std::uint8_t>(mask.width(), mask.height())};
  const cv::Mat distance = border_distance(mask);
  // All places where a carriageway's middle can be; where that is a strip, its sides are two middles.
  cv::Mat places = distance >= radius_px;
  cv::Mat square = distance > options.most_widths * radius_px;
  cv::dilate(square, square, disc(options.square_margin * radius_px));
  places.setTo(0, square);
  cv::morphologyEx(places, places, cv::MORPH_OPEN, disc(0.5 * options.least_apart_px));
  remove_short_pieces(places, options.least_length_widths * 2.0 * radius_px);
  return carriageway_sides(mask, places, radius_px, options);
}

ThinningGuide carriageways_in(const Raster<std::uint8_t>& mask, const CentreLines& lines,
                              std::span<const double> radii_px, const CarriagewayOptions& options) {
  ThinningGuide out{Raster<std::uint8_t>(mask.width(), mask.height()),
                    Raster<std::uint8_t>(mask.width(), mask.height())};
  cv::Mat kept(mask.height(), mask.width(), CV_8U, out.kept.data());
  cv::Mat outside(mask.height(), mask.width(), CV_8U, out.outside.data());
  std::vector<double> radii(radii_px.begin(), radii_px.end());
  std::sort(radii.begin(), radii.end());
  radii.erase(std::unique(radii.begin(), radii.end()), radii.end());
  for (const double radius : radii) {
    cv::Mat zone = cv::Mat::zeros(mask.height(), mask.width(), CV_8U);
    for (std::size_t i = 0; i < lines.lines.size(); ++i)
      if (radii_px[i] == radius)
        for (const MapPoint p : lines.lines[i].points)
          cv::circle(zone, {static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y))},
                     static_cast<int>(std::ceil(lines.lines[i].radius_px)), cv::Scalar(1), cv::FILLED);
    const ThinningGuide guide = carriageways_in(mask, radius, options);
    cv::Mat(mask.height(), mask.width(), CV_8U, const_cast<std::uint8_t*>(guide.kept.data()))
        .copyTo(kept, zone);
    cv::Mat(mask.height(), mask.width(), CV_8U, const_cast<std::uint8_t*>(guide.outside.data()))
        .copyTo(outside, zone);
  }
  return out;
}

}  // namespace palpable::vision
