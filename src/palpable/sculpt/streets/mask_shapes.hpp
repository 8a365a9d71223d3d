// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <opencv2/core.hpp>

// Shapes of masks (CV_8U, 0 or 255) by exact distances; lengths in samples. Outside of a mask nothing is
// known: its border is none.
namespace palpable::sculpt {

/// Distance of each sample to the nearest one of the mask; far for an empty mask.
cv::Mat distance_to(const cv::Mat& mask);
/// Distance of each sample of the mask to the nearest one outside of it, less half a sample; 0 outside.
cv::Mat distance_inside(const cv::Mat& mask);

cv::Mat dilated(const cv::Mat& mask, double radius);
/// What circles of this radius inside of the mask cover.
cv::Mat opened(const cv::Mat& mask, double radius);
/// The mask with its gaps that no circle of this radius fits into.
cv::Mat closed(const cv::Mat& mask, double radius);

/// What of a mask is more than `tolerance` away from every circle of this radius inside of it, without parts
/// that are no larger than the two corners of a right angle.
cv::Mat narrow_parts(const cv::Mat& mask, double radius, double tolerance);

/// A connected part of a mask (8 neighbours).
struct MaskPart {
  std::vector<cv::Point> samples;
  double area = 0.0;
};
std::vector<MaskPart> components_of(const cv::Mat& mask);

template <class Visit>
void each_component(const cv::Mat& mask, const Visit& visit) {
  for (const MaskPart& part : components_of(mask)) visit(part);
}

/// Two parts that are too near each other: numbers in the order of components_of(), where, and how near.
struct NarrowGap {
  int first = 0;
  int second = 0;
  cv::Point at;
  double width = 0.0;
};

/// Pairs of parts of a mask that are less than this apart, one for each pair.
std::vector<NarrowGap> narrow_gaps(const cv::Mat& mask, double least);

}  // namespace palpable::sculpt
