// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/colours/map_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

bool alike(Rgb8 a, Rgb8 b, int most) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) <= most;
}

MapFrame whole(const Raster<Rgb8>& picture) {
  const double right = picture.width() - 1;
  const double bottom = picture.height() - 1;
  return {{{0.0, 0.0}, {right, 0.0}, {right, bottom}, {0.0, bottom}}, false};
}

/// The colour of all four corners of the picture.
std::optional<Rgb8> page_colour(const Raster<Rgb8>& picture, const MapFrameOptions& options) {
  const int in = options.page_corner_px;
  const int right = picture.width() - 1 - in;
  const int bottom = picture.height() - 1 - in;
  if (right <= in || bottom <= in) return std::nullopt;
  const Rgb8 page = picture(in, in);
  const bool is_same = alike(picture(right, in), page, options.page_tolerance) &&
                       alike(picture(in, bottom), page, options.page_tolerance) &&
                       alike(picture(right, bottom), page, options.page_tolerance);
  return is_same ? std::optional(page) : std::nullopt;
}

/// Part of the points between two corners, moved by `in`, that are set.
double part_set(const cv::Mat& mask, cv::Point2f a, cv::Point2f b, cv::Point2f in) {
  const int steps = std::max(1, static_cast<int>(cv::norm(b - a)));
  int inside = 0;
  int set = 0;
  for (int i = 0; i <= steps; ++i) {
    const cv::Point p = a + (static_cast<float>(i) / static_cast<float>(steps)) * (b - a) + in;
    if (p.x < 0 || p.y < 0 || p.x >= mask.cols || p.y >= mask.rows) continue;
    ++inside;
    set += mask.at<std::uint8_t>(p) != 0 ? 1 : 0;
  }
  return inside == 0 ? 1.0 : static_cast<double>(set) / inside;
}

/// Whether the map fills a rectangle up to its sides and the rest of the picture is page.
bool is_map_on_page(const cv::Mat& differs, const std::array<cv::Point2f, 4>& corners,
                    const MapFrameOptions& options) {
  const cv::Point2f middle = 0.25F * (corners[0] + corners[1] + corners[2] + corners[3]);
  const auto in = static_cast<float>(options.side_inside_px);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const cv::Point2f a = corners[i];
    const cv::Point2f b = corners[(i + 1) % corners.size()];
    const cv::Point2f to = middle - 0.5F * (a + b);
    const auto n = static_cast<float>(cv::norm(to));
    if (n < in || part_set(differs, a, b, (in / n) * to) < options.least_side_part) return false;
  }
  cv::Mat outside(differs.size(), CV_8U, cv::Scalar(255));
  const std::vector<cv::Point> polygon(corners.begin(), corners.end());
  cv::fillConvexPoly(outside, polygon, cv::Scalar(0));
  // The edge itself is a mixture.
  cv::erode(outside, outside, cv::getStructuringElement(cv::MORPH_RECT, {options.edge_px, options.edge_px}));
  const int all = cv::countNonZero(outside);
  return all >= options.least_outside_part * static_cast<double>(differs.total()) &&
         cv::countNonZero(outside & differs) <= (1.0 - options.least_page_part) * all;
}

/// Calls use(a, inward normal) for each side.
template <class Use>
void for_each_side(const MapFrame& frame, Use&& use) {
  MapPoint middle;
  for (const MapPoint c : frame.corners) middle = {middle.x + 0.25 * c.x, middle.y + 0.25 * c.y};
  for (std::size_t i = 0; i < frame.corners.size(); ++i) {
    const MapPoint a = frame.corners[i];
    const MapPoint b = frame.corners[(i + 1) % frame.corners.size()];
    const double length = std::max(1e-9, std::hypot(b.x - a.x, b.y - a.y));
    MapPoint in{-(b.y - a.y) / length, (b.x - a.x) / length};
    if (in.x * (middle.x - a.x) + in.y * (middle.y - a.y) < 0.0) in = {-in.x, -in.y};
    use(a, in);
  }
}

}  // namespace

MapFrame find_map_frame(const Raster<Rgb8>& picture, const MapFrameOptions& options) {
  const auto page = page_colour(picture, options);
  if (!page) return whole(picture);
  cv::Mat differs(picture.height(), picture.width(), CV_8U);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x)
      differs.at<std::uint8_t>(y, x) = alike(picture(x, y), *page, options.page_tolerance) ? 0 : 255;
  // Streets in the page's colour divide the map; what is written beside it is small.
  cv::Mat solid, labels, stats, centres;
  cv::morphologyEx(differs, solid, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_RECT, {options.closing_px, options.closing_px}));
  const int n = cv::connectedComponentsWithStats(solid, labels, stats, centres, 8);
  int largest = 0;
  for (int i = 1; i < n; ++i)
    if (largest == 0 || stats.at<int>(i, cv::CC_STAT_AREA) > stats.at<int>(largest, cv::CC_STAT_AREA))
      largest = i;
  if (largest == 0) return whole(picture);
  std::vector<cv::Point> points;
  cv::findNonZero((labels == largest) & differs, points);
  if (points.empty()) return whole(picture);
  std::vector<cv::Point> hull;
  cv::convexHull(points, hull);
  const cv::RotatedRect box = cv::minAreaRect(hull);
  std::array<cv::Point2f, 4> corners;
  box.points(corners.data());
  if (!is_map_on_page(differs, corners, options)) return whole(picture);
  MapFrame out{{}, true};
  const auto inset = static_cast<float>(options.inset_px);
  cv::RotatedRect inner = box;
  inner.size.width = std::max(1.0F, box.size.width - 2.0F * inset);
  inner.size.height = std::max(1.0F, box.size.height - 2.0F * inset);
  inner.points(corners.data());
  for (const cv::Point2f c : corners) out.corners.push_back({c.x, c.y});
  return out;
}

double distance_to_side(const MapFrame& frame, MapPoint p) {
  double least = std::numeric_limits<double>::infinity();
  for_each_side(frame, [&](MapPoint a, MapPoint in) {
    least = std::min(least, (p.x - a.x) * in.x + (p.y - a.y) * in.y);
  });
  return least;
}

double distance_to_side(const MapFrame& frame, MapPoint p, MapPoint direction) {
  double least = std::numeric_limits<double>::infinity();
  for_each_side(frame, [&](MapPoint a, MapPoint in) {
    const double nearing = -(direction.x * in.x + direction.y * in.y);
    if (nearing > 0.0) least = std::min(least, ((p.x - a.x) * in.x + (p.y - a.y) * in.y) / nearing);
  });
  return least;
}

}  // namespace palpable::vision
