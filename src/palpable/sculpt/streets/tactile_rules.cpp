// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/streets/tactile_rules.hpp"

#include "palpable/sculpt/streets/mask_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace palpable::sculpt {
namespace {

using Rule = TactileViolation::Rule;

cv::Mat mask_of(const Raster<MapPart>& parts, MapPart part) {
  cv::Mat mask(parts.height(), parts.width(), CV_8U);
  for (int y = 0; y < parts.height(); ++y)
    for (int x = 0; x < parts.width(); ++x) mask.at<std::uint8_t>(y, x) = parts(x, y) == part ? 255 : 0;
  return mask;
}

/// A relief as it is checked: masks of its parts, and heights over its land.
class CheckedRelief {
 public:
  CheckedRelief(const models::Relief& relief, const Raster<MapPart>& parts, const TactileRules& rules)
      : relief_(relief), parts_(parts), rules_(rules), sample_m_(relief.pixel_m()) {
    above_land_ = cv::Mat(parts.height(), parts.width(), CV_32F);
    std::vector<float> land;
    for (int y = 0; y < parts.height(); ++y)
      for (int x = 0; x < parts.width(); ++x) {
        const auto [px, py] = place_of({x, y});
        above_land_.at<float>(y, x) = static_cast<float>(relief.sample(px, py).z_m);
        if (parts(x, y) == MapPart::land) land.push_back(above_land_.at<float>(y, x));
      }
    if (land.empty()) return;
    const auto middle = land.begin() + static_cast<std::ptrdiff_t>(land.size() / 2);
    std::nth_element(land.begin(), middle, land.end());
    above_land_ -= *middle;
  }

  std::vector<TactileViolation> take() {
    for (const MapPart part : {MapPart::street, MapPart::building, MapPart::water}) check_relief(part);
    check_width(MapPart::street, Rule::narrow_groove, rules_.least_groove_m);
    check_ridges();
    for (const MapPart part : {MapPart::building, MapPart::water}) {
      check_small(part);
      check_gaps(part, mask_of(part));
    }
    check_banks();
    return std::move(found_);
  }

 private:
  std::pair<double, double> place_of(cv::Point p) const {
    return {(p.x + 0.5) * sample_m_ - 0.5 * relief_.size_x_m(),
            0.5 * relief_.size_y_m() - (p.y + 0.5) * sample_m_};
  }

  void add(Rule rule, MapPart part, cv::Point at, double measured_m) {
    const auto [x, y] = place_of(at);
    found_.push_back({rule, part, x, y, measured_m});
  }

  cv::Mat mask_of(MapPart part) const { return sculpt::mask_of(parts_, part); }

  double samples_of(double length_m) const { return length_m / sample_m_; }
  double tolerance() const { return rules_.width_tolerance; }

  /// Near every sample of a part there is one of full height or depth.
  void check_relief(MapPart part) {
    const cv::Mat mask = mask_of(part);
    const double sign = part == MapPart::building ? 1.0 : -1.0;
    const cv::Mat full = (sign * above_land_ >= rules_.least_relief_m - rules_.height_tolerance_m) & mask;
    const double reach = samples_of(0.5 * std::max(rules_.least_groove_m, rules_.least_part_m)) + tolerance();
    const cv::Mat low = mask & (distance_to(full) > reach);
    each_component(low, [&](const MaskPart& c) {
      if (c.area < corner_area(0.5 * rules_.least_part_m)) return;
      double most = 0.0;
      for (const cv::Point p : c.samples)
        most = std::max(most, sign * static_cast<double>(above_land_.at<float>(p)));
      add(Rule::low_relief, part, c.samples.front(), most);
    });
  }

  /// Samples of a corner of a right angle that a circle of this radius does not reach, twice.
  double corner_area(double radius_m) const {
    constexpr double kOfSquare = 2.0 * (1.0 - 0.7853981633974483);
    const double radius = samples_of(radius_m);
    return kOfSquare * radius * radius;
  }

  /// Places of a mask that no circle of the least width inside of it reaches.
  void report_narrow(const cv::Mat& mask, Rule rule, MapPart part, double width_m) {
    if (samples_of(0.5 * width_m) <= 2.0 * tolerance()) return;
    const cv::Mat inside = distance_inside(mask);
    each_component(narrow_parts(mask, samples_of(0.5 * width_m), tolerance()), [&](const MaskPart& c) {
      const auto widest = std::max_element(c.samples.begin(), c.samples.end(), [&](cv::Point a, cv::Point b) {
        return inside.at<float>(a) < inside.at<float>(b);
      });
      add(rule, part, *widest, 2.0 * sample_m_ * static_cast<double>(inside.at<float>(*widest)));
    });
  }

  void check_width(MapPart part, Rule rule, double width_m) {
    report_narrow(mask_of(part), rule, part, width_m);
  }

  /// Land between grooves.
  void check_ridges() {
    report_narrow(~mask_of(MapPart::street), Rule::narrow_gap, MapPart::street, rules_.least_gap_m);
  }

  void check_small(MapPart part) {
    const cv::Mat mask = mask_of(part), inside = distance_inside(mask);
    each_component(mask, [&](const MaskPart& c) {
      double widest = 0.0;
      for (const cv::Point p : c.samples) widest = std::max(widest, static_cast<double>(inside.at<float>(p)));
      if (widest < samples_of(0.5 * rules_.least_part_m) - tolerance())
        add(Rule::small_part, part, c.samples.front(), 2.0 * sample_m_ * widest);
    });
  }

  void check_gaps(MapPart part, const cv::Mat& mask) {
    for (const NarrowGap& gap : narrow_gaps(mask, samples_of(rules_.least_gap_m) - tolerance()))
      add(Rule::narrow_gap, part, gap.at, sample_m_ * gap.width);
  }

  /// Land between water and streets.
  void check_banks() {
    const cv::Mat from_street = distance_to(mask_of(MapPart::street));
    const cv::Mat near =
        mask_of(MapPart::water) & (from_street < samples_of(rules_.least_gap_m) - tolerance());
    each_component(near, [&](const MaskPart& c) {
      double least = 1e9;
      for (const cv::Point p : c.samples)
        least = std::min(least, static_cast<double>(from_street.at<float>(p)));
      add(Rule::narrow_gap, MapPart::water, c.samples.front(), sample_m_ * least);
    });
  }

  const models::Relief& relief_;
  const Raster<MapPart>& parts_;
  const TactileRules& rules_;
  double sample_m_;
  cv::Mat above_land_;
  std::vector<TactileViolation> found_;
};

}  // namespace

std::string_view words_of(TactileViolation::Rule rule) {
  switch (rule) {
    case Rule::low_relief:
      return "the relief is too low";
    case Rule::narrow_gap:
      return "the gap is too narrow";
    case Rule::narrow_groove:
      return "the groove is too narrow";
    case Rule::small_part:
      return "it is too small";
  }
  return "";
}

std::vector<TactileViolation> check_tactile_rules(const models::Relief& relief, const Raster<MapPart>& parts,
                                                  const TactileRules& rules) {
  return CheckedRelief(relief, parts, rules).take();
}

double hollow_part(const Raster<MapPart>& parts, double sample_m, const TactileRules& rules) {
  if (parts.width() == 0 || parts.height() == 0) return 0.0;
  // Beyond the plate is no groove.
  cv::Mat ringed;
  cv::copyMakeBorder(mask_of(parts, MapPart::street), ringed, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  const cv::Mat hollow = opened(ringed, 0.5 * rules.hollow_m / sample_m);
  return cv::countNonZero(hollow) / (static_cast<double>(parts.width()) * parts.height());
}

}  // namespace palpable::sculpt
