// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/carriageway_sides.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// For each pixel of a mask, the nearest pixel outside of it.
class Feet {
 public:
  explicit Feet(const Raster<std::uint8_t>& mask) {
    const cv::Mat view(mask.height(), mask.width(), CV_8U, const_cast<std::uint8_t*>(mask.data()));
    cv::Mat distance;
    cv::distanceTransform(view, distance, labels_, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
    at_.resize(mask.count() + 1);
    for (int y = 0; y < mask.height(); ++y)
      for (int x = 0; x < mask.width(); ++x)
        if (mask(x, y) == 0) at_[static_cast<std::size_t>(labels_.at<int>(y, x))] = {x, y};
  }
  cv::Point of(cv::Point p) const { return at_[static_cast<std::size_t>(labels_.at<int>(p))]; }

 private:
  cv::Mat labels_;
  std::vector<cv::Point> at_;
};

using Contour = std::vector<cv::Point>;

/// A part of a closed contour: from its point `first`, `count` points.
struct Run {
  int first = 0;
  int count = 0;
  bool follows = false;
};

cv::Point at(const Contour& contour, int i) {
  const int n = static_cast<int>(contour.size());
  return contour[static_cast<std::size_t>(((i % n) + n) % n)];
}

/// The parts of a contour that follow the mask's border, and those between them.
std::vector<Run> runs_of(const Contour& contour, const Feet& feet, double radius_px,
                         const CarriagewayOptions& options) {
  const int n = static_cast<int>(contour.size());
  const int window = std::max(2, static_cast<int>(std::lround(options.side_window * radius_px)));
  std::vector<char> follows(contour.size());
  for (int i = 0; i < n; ++i) {
    const double along = cv::norm(at(contour, i + window) - at(contour, i - window));
    const double foot = cv::norm(feet.of(at(contour, i + window)) - feet.of(at(contour, i - window)));
    follows[static_cast<std::size_t>(i)] = foot >= options.least_side_ratio * along ? 1 : 0;
  }
  int start = 0;
  while (start < n &&
         follows[static_cast<std::size_t>(start)] == follows[static_cast<std::size_t>((start + n - 1) % n)])
    ++start;
  if (start == n) return {{0, n, follows.front() != 0}};
  std::vector<Run> runs;
  for (int k = 0; k < n; ++k) {
    const bool here = follows[static_cast<std::size_t>((start + k) % n)] != 0;
    if (runs.empty() || runs.back().follows != here) runs.push_back({(start + k) % n, 0, here});
    ++runs.back().count;
  }
  return runs;
}

/// Whether a side that ends at a run goes on straight behind it.
bool goes_on(const Contour& contour, const Run& run, double radius_px, const CarriagewayOptions& options) {
  const int window = std::max(3, static_cast<int>(std::lround(radius_px)));
  const cv::Point2d from = at(contour, run.first - 1);
  const cv::Point2d to = at(contour, run.first + run.count);
  const cv::Point2d before = from - cv::Point2d(at(contour, run.first - 1 - window));
  const cv::Point2d after = cv::Point2d(at(contour, run.first + run.count + window)) - to;
  const cv::Point2d gap = to - from;
  const double least = std::cos(options.side_angle_deg * std::numbers::pi / 180.0);
  const auto is_along = [least](cv::Point2d a, cv::Point2d b) {
    return a.dot(b) >= least * cv::norm(a) * cv::norm(b);
  };
  return is_along(before, gap) && is_along(gap, after) && is_along(before, after);
}

/// What is drawn of a strip's sides: middles, and where no carriageway is shown.
struct Drawn {
  cv::Mat kept, outside;
};

void draw_run(const Contour& contour, const Run& run, const Feet& feet, bool is_continued, Drawn& drawn) {
  if (run.follows) {
    for (int i = 0; i < run.count; ++i) drawn.kept.at<std::uint8_t>(at(contour, run.first + i)) = 1;
    return;
  }
  if (is_continued) {
    cv::line(drawn.kept, at(contour, run.first - 1), at(contour, run.first + run.count), cv::Scalar(1));
    return;
  }
  for (int i = 0; i < run.count; ++i) {
    const cv::Point p = at(contour, run.first + i);
    cv::line(drawn.outside, p, feet.of(p), cv::Scalar(1), 2);
  }
}

/// An outer contour and its holes, by their numbers.
std::vector<std::size_t> contours_of_strip(const std::vector<cv::Vec4i>& tree, std::size_t outer) {
  std::vector<std::size_t> out{outer};
  for (int hole = tree[outer][2]; hole >= 0; hole = tree[static_cast<std::size_t>(hole)][0])
    out.push_back(static_cast<std::size_t>(hole));
  return out;
}

}  // namespace

ThinningGuide carriageway_sides(const Raster<std::uint8_t>& mask, const cv::Mat& places, double radius_px,
                                const CarriagewayOptions& options) {
  ThinningGuide guide{Raster<std::uint8_t>(mask.width(), mask.height()),
                      Raster<std::uint8_t>(mask.width(), mask.height())};
  Drawn drawn{{mask.height(), mask.width(), CV_8U, guide.kept.data()},
              {mask.height(), mask.width(), CV_8U, guide.outside.data()}};
  std::vector<Contour> contours;
  std::vector<cv::Vec4i> tree;
  cv::findContours(places, contours, tree, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  if (contours.empty()) return guide;
  const Feet feet(mask);
  for (std::size_t outer = 0; outer < contours.size(); ++outer) {
    if (tree[outer][3] >= 0) continue;
    std::vector<std::pair<const Contour*, Run>> runs;
    int following = 0;
    for (const std::size_t i : contours_of_strip(tree, outer))
      for (const Run& run : runs_of(contours[i], feet, radius_px, options)) {
        runs.emplace_back(&contours[i], run);
        following += run.follows ? run.count : 0;
      }
    if (following < options.least_side_widths * 2.0 * radius_px) continue;
    cv::drawContours(drawn.outside, contours, static_cast<int>(outer), cv::Scalar(1), cv::FILLED, 8, tree, 1);
    for (const auto& [contour, run] : runs)
      draw_run(*contour, run, feet, !run.follows && goes_on(*contour, run, radius_px, options), drawn);
    drawn.outside.setTo(0, drawn.kept);
  }
  return guide;
}

}  // namespace palpable::vision
