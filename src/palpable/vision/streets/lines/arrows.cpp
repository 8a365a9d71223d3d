// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/arrows.hpp"

#include "palpable/vision/streets/lines/border_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// Sums over the pixels of a dark piece.
struct DarkPiece {
  double n = 0.0;
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  void add(double u, double v) {
    n += 1.0;
    x += u;
    y += v;
    xx += u * u;
    xy += u * v;
    yy += v * v;
  }
  MapPoint middle() const { return {x / n, y / n}; }
  /// Standard deviations along and across, pixels, and the direction of the first.
  struct Spread {
    double along = 0.0;
    double across = 0.0;
    MapPoint direction;
  };
  Spread spread() const {
    const double a = xx / n - x / n * (x / n);
    const double b = xy / n - x / n * (y / n);
    const double c = yy / n - y / n * (y / n);
    const double half = std::hypot(0.5 * (a - c), b);
    const double angle = 0.5 * std::atan2(2.0 * b, a - c);
    return {std::sqrt(std::max(0.0, 0.5 * (a + c) + half)),
            std::sqrt(std::max(0.0, 0.5 * (a + c) - half)),
            {std::cos(angle), std::sin(angle)}};
  }
};

/// The line that is nearest to a place, and its distance; the number of lines if there are none.
struct NearestLine {
  std::size_t line = 0;
  std::size_t point = 0;
  double distance = std::numeric_limits<double>::max();
};
NearestLine nearest_line(const CentreLines& lines, MapPoint at) {
  NearestLine best{lines.lines.size()};
  for (std::size_t i = 0; i < lines.lines.size(); ++i)
    for (std::size_t k = 0; k < lines.lines[i].points.size(); ++k) {
      const MapPoint p = lines.lines[i].points[k];
      if (const double d = std::hypot(p.x - at.x, p.y - at.y); d < best.distance) best = {i, k, d};
    }
  return best;
}

/// Whether an arrow points along a line, at one of its points.
bool is_along(const Arrow& arrow, const CentreLine& line, std::size_t point, const ArrowOptions& options) {
  const auto reach = static_cast<std::size_t>(options.direction_points);
  const MapPoint from = line.points[point - std::min(point, reach)];
  const MapPoint to = line.points[std::min(line.points.size() - 1, point + reach)];
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const double facing = (to.x - from.x) * arrow.along.x + (to.y - from.y) * arrow.along.y;
  return std::abs(facing) >= length * std::cos(options.angle_deg * std::numbers::pi / 180.0);
}

/// The widest radius that enough arrows have.
std::optional<double> widest_common(std::vector<double> radii, const ArrowOptions& options) {
  std::sort(radii.rbegin(), radii.rend());
  const double least = std::max(static_cast<double>(options.fewest_of_colour),
                                options.common_part * static_cast<double>(radii.size()));
  for (const double radius : radii) {
    double n = 0.0;
    double sum = 0.0;
    for (const double r : radii)
      if (std::abs(r - radius) <= options.same_radius * radius) {
        n += 1.0;
        sum += r;
      }
    if (n >= least) return sum / n;
  }
  return std::nullopt;
}

std::ptrdiff_t middle_of(const std::vector<double>& values) {
  return static_cast<std::ptrdiff_t>(values.size() / 2);
}

}  // namespace

std::vector<Arrow> find_arrows(const Raster<Rgb8>& picture, const Raster<std::uint8_t>& mask, Rgb8 street,
                               const ArrowOptions& options) {
  const auto luma = [](Rgb8 c) { return 0.299 * c.r + 0.587 * c.g + 0.114 * c.b; };
  const double most = luma(street) - options.least_contrast;
  const cv::Mat distance = border_distance(mask);
  cv::Mat dark = cv::Mat::zeros(mask.height(), mask.width(), CV_8U);
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (distance.at<float>(y, x) >= options.inside_px && luma(picture(x, y)) < most)
        dark.at<std::uint8_t>(y, x) = 1;
  cv::Mat labels;
  std::vector<DarkPiece> pieces(static_cast<std::size_t>(cv::connectedComponents(dark, labels, 8)));
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (const int label = labels.at<int>(y, x); label > 0)
        pieces[static_cast<std::size_t>(label)].add(x, y);
  std::vector<Arrow> out;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const auto [along, across, direction] = pieces[i].spread();
    // A strip of length l has the standard deviation l / sqrt(12).
    const double length = std::sqrt(12.0) * along;
    if (pieces[i].n < options.least_area_px || length < options.shortest_px || length > options.longest_px ||
        along < options.least_elongation * across)
      continue;
    const MapPoint at = pieces[i].middle();
    bool is_alone = true;
    for (std::size_t k = 1; k < pieces.size() && is_alone; ++k)
      is_alone = k == i || std::hypot(pieces[k].middle().x - at.x, pieces[k].middle().y - at.y) >=
                               options.apart_lengths * length;
    if (is_alone) out.push_back({at, direction});
  }
  return out;
}

std::vector<double> radii_by_arrows(const Raster<std::uint8_t>& mask, const CentreLines& lines,
                                    std::span<const Arrow> arrows, double otherwise,
                                    const ArrowOptions& options) {
  const cv::Mat distance = border_distance(mask);
  std::vector<std::vector<double>> of_line(lines.lines.size());
  // Whether an arrow's distances from the middle and from the border together are the area's radius.
  std::vector<bool> agrees(lines.lines.size(), false);
  std::vector<double> all;
  std::size_t in_middle = 0;
  for (const Arrow& arrow : arrows) {
    const auto [line, point, aside] = nearest_line(lines, arrow.at);
    if (line == lines.lines.size() || !is_along(arrow, lines.lines[line], point, options)) continue;
    const double radius = distance.at<float>(static_cast<int>(std::lround(arrow.at.y)),
                                             static_cast<int>(std::lround(arrow.at.x)));
    const double area = aside + radius;
    if (aside > options.most_aside * area) continue;
    if (aside < std::max(options.least_aside_px, options.least_aside * area)) {
      ++in_middle;
      continue;
    }
    of_line[line].push_back(radius);
    agrees[line] = agrees[line] || std::abs(area - lines.lines[line].radius_px) <= options.same_radius * area;
    all.push_back(radius);
  }
  // Where most arrows are in the middle, the colour's streets are single carriageways.
  if (in_middle > all.size()) all.clear();
  const double common = widest_common(std::move(all), options).value_or(otherwise);
  std::vector<double> out;
  for (std::size_t i = 0; i < of_line.size(); ++i) {
    std::vector<double>& radii = of_line[i];
    const bool is_enough = agrees[i] || radii.size() >= static_cast<std::size_t>(options.fewest_of_street);
    if (is_enough) std::nth_element(radii.begin(), radii.begin() + middle_of(radii), radii.end());
    out.push_back(is_enough ? radii[static_cast<std::size_t>(middle_of(radii))] : common);
  }
  return out;
}

}  // namespace palpable::vision
