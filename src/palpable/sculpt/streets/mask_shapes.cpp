// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/streets/mask_shapes.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace palpable::sculpt {

cv::Mat distance_to(const cv::Mat& mask) {
  cv::Mat distance;
  if (cv::countNonZero(mask) == 0) return cv::Mat(mask.size(), CV_32F, cv::Scalar(1e9));
  cv::distanceTransform(~mask, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance;
}

cv::Mat distance_inside(const cv::Mat& mask) {
  cv::Mat distance = cv::max(distance_to(~mask) - 0.5, 0.0);
  distance.setTo(0.0, ~mask);
  return distance;
}

cv::Mat dilated(const cv::Mat& mask, double radius) { return distance_to(mask) <= radius; }

cv::Mat opened(const cv::Mat& mask, double radius) {
  // Circles may reach, and have their middle, beyond the border.
  const int margin = static_cast<int>(radius) + 2;
  cv::Mat padded;
  cv::copyMakeBorder(mask, padded, margin, margin, margin, margin, cv::BORDER_CONSTANT, cv::Scalar(255));
  // A circle of this radius around a sample whose nearest sample outside is half a sample beyond it.
  const cv::Mat covered = dilated(distance_to(~padded) >= radius + 0.5, radius);
  return mask & covered(cv::Rect(margin, margin, mask.cols, mask.rows));
}

cv::Mat closed(const cv::Mat& mask, double radius) { return ~opened(~mask, radius); }

cv::Mat narrow_parts(const cv::Mat& mask, double radius, double tolerance) {
  constexpr double kCornersOfSquare = 2.0 * (1.0 - 0.7853981633974483);
  cv::Mat narrow = mask & ~dilated(opened(mask, radius - tolerance), tolerance);
  for (const MaskPart& part : components_of(narrow))
    if (part.area <= kCornersOfSquare * radius * radius)
      for (const cv::Point p : part.samples) narrow.at<std::uint8_t>(p) = 0;
  return narrow;
}

std::vector<MaskPart> components_of(const cv::Mat& mask) {
  cv::Mat numbers;
  const int count = cv::connectedComponents(mask, numbers, 8, CV_32S);
  std::vector<MaskPart> parts(static_cast<std::size_t>(std::max(0, count - 1)));
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (const int number = numbers.at<int>(y, x); number > 0)
        parts[static_cast<std::size_t>(number - 1)].samples.emplace_back(x, y);
  for (MaskPart& part : parts) part.area = static_cast<double>(part.samples.size());
  return parts;
}

std::vector<NarrowGap> narrow_gaps(const cv::Mat& mask, double least) {
  cv::Mat numbers, distance, nearest;
  cv::connectedComponents(mask, numbers, 8, CV_32S);
  cv::distanceTransform(~mask, distance, nearest, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  // From the numbers of mask samples in `nearest` to those of the components.
  std::vector<int> part_of(static_cast<std::size_t>(mask.total()) + 1, 0);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (mask.at<std::uint8_t>(y, x) != 0)
        part_of[static_cast<std::size_t>(nearest.at<int>(y, x))] = numbers.at<int>(y, x) - 1;
  std::map<std::pair<int, int>, NarrowGap> gaps;
  const auto compare = [&](cv::Point a, cv::Point b) {
    const int of_a = part_of[static_cast<std::size_t>(nearest.at<int>(a))];
    const int of_b = part_of[static_cast<std::size_t>(nearest.at<int>(b))];
    if (of_a == of_b) return;
    // From border to border: the samples between the two and themselves.
    const double width =
        static_cast<double>(distance.at<float>(a)) + static_cast<double>(distance.at<float>(b));
    if (width >= least) return;
    const std::pair key = std::minmax(of_a, of_b);
    const auto known = gaps.find(key);
    if (known == gaps.end() || width < known->second.width) gaps[key] = {key.first, key.second, a, width};
  };
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      if (x + 1 < mask.cols) compare({x, y}, {x + 1, y});
      if (y + 1 < mask.rows) compare({x, y}, {x, y + 1});
    }
  std::vector<NarrowGap> list;
  for (const auto& [key, gap] : gaps) list.push_back(gap);
  return list;
}

}  // namespace palpable::sculpt
