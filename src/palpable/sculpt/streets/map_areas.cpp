// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/streets/map_areas.hpp"

#include "palpable/sculpt/streets/mask_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace palpable::sculpt {
namespace {

std::vector<cv::Point> outline_in(const MapGrid& grid, const MapArea& area) {
  std::vector<cv::Point> outline;
  for (const MapPoint p : area.outline) {
    const MapPoint at = grid.at(p);
    outline.emplace_back(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)));
  }
  return outline;
}

/// Without parts that no circle of the least width fits into.
cv::Mat without_small(const cv::Mat& mask, double radius) {
  const cv::Mat inside = distance_inside(mask);
  cv::Mat kept = cv::Mat::zeros(mask.size(), CV_8U);
  each_component(mask, [&](const MaskPart& part) {
    const bool is_wide = std::any_of(part.samples.begin(), part.samples.end(),
                                     [&](cv::Point p) { return inside.at<float>(p) >= radius; });
    if (is_wide)
      for (const cv::Point p : part.samples) kept.at<std::uint8_t>(p) = 255;
  });
  return kept;
}

/// Without the smaller one of two parts that are too near each other, until there are none; a part with
/// something special counts as the larger one.
cv::Mat without_near(cv::Mat mask, double least, const cv::Mat& special) {
  constexpr int kMostRounds = 20;
  const auto is_special = [&special](const MaskPart& part) {
    return !special.empty() && std::any_of(part.samples.begin(), part.samples.end(),
                                           [&](cv::Point p) { return special.at<std::uint8_t>(p) != 0; });
  };
  for (int round = 0; round < kMostRounds; ++round) {
    const auto gaps = narrow_gaps(mask, least);
    if (gaps.empty()) break;
    const auto parts = components_of(mask);
    for (const NarrowGap& gap : gaps) {
      const MaskPart& a = parts[static_cast<std::size_t>(gap.first)];
      const MaskPart& b = parts[static_cast<std::size_t>(gap.second)];
      const bool drops_first = is_special(a) == is_special(b) ? a.area < b.area : !is_special(a);
      for (const cv::Point p : (drops_first ? a : b).samples) mask.at<std::uint8_t>(p) = 0;
    }
  }
  return mask;
}

}  // namespace

FeltAreas felt_areas(const StreetMap& map, MapArea::Kind kind, const MapGrid& grid, const cv::Mat& grooves,
                     double gap_m, const TactileRules& rules, double rounding, const cv::Mat& special) {
  FeltAreas out;
  out.mask = cv::Mat::zeros(grid.rows, grid.columns, CV_8U);
  for (const MapArea& area : map.areas) {
    if (area.kind != kind || area.outline.empty()) continue;
    ++out.drawn;
    cv::fillPoly(out.mask, std::vector<std::vector<cv::Point>>{outline_in(grid, area)}, cv::Scalar(255));
  }
  const bool has_special = !special.empty() && cv::countNonZero(special) > 0;
  if (has_special) out.mask |= special;
  if (out.drawn == 0 && !has_special) return out;
  const double gap = rules.least_gap_m * grid.of_metre, half_part = 0.5 * rules.least_part_m * grid.of_metre;
  const cv::Mat allowed = distance_to(grooves) > gap_m * grid.of_metre;
  out.mask = closed(out.mask & allowed, 0.5 * gap) & allowed;
  out.mask = without_near(without_small(opened(out.mask, rounding * half_part), half_part), gap, special);
  out.parts = components_of(out.mask).size();
  for (const MapArea& area : map.areas) {
    if (area.kind != kind || area.outline.empty()) continue;
    const auto outline = outline_in(grid, area);
    const cv::Rect box = cv::boundingRect(outline) & cv::Rect(0, 0, grid.columns, grid.rows);
    if (box.empty()) {
      ++out.left_out;
      continue;
    }
    cv::Mat local = cv::Mat::zeros(box.size(), CV_8U);
    cv::fillPoly(local, std::vector<std::vector<cv::Point>>{outline}, cv::Scalar(255), cv::LINE_8, 0,
                 -box.tl());
    if (cv::countNonZero(local & out.mask(box)) == 0) ++out.left_out;
  }
  return out;
}

}  // namespace palpable::sculpt
