// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/tracked_matches.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/vision/image/opencv_image.hpp"
#include "palpable/vision/stereo/methods/match.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace palpable::vision {
namespace {

/// The picture by a whole factor smaller.
Image shrunk_by(const Image& image, int factor) {
  if (factor == 1) return image;
  cv::Mat out;
  cv::resize(view_of(image), out, {image.width / factor, image.height / factor}, 0, 0, cv::INTER_AREA);
  return image_from(out, image);
}

std::vector<cv::Point2f> corners_of(const cv::Mat& grey, const CornerTrackingOptions& options) {
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(grey, corners, options.most_corners, options.corner_quality,
                          std::max(options.spacing_px, grey.cols / options.corners_across));
  return corners;
}

std::vector<cv::Point2f> tracked(const cv::Mat& from, const cv::Mat& to, const std::vector<cv::Point2f>& at,
                                 std::vector<cv::Point2f> about, std::vector<std::uint8_t>& found,
                                 const CornerTrackingOptions& options) {
  std::vector<float> errors;
  cv::calcOpticalFlowPyrLK(
      from, to, at, about, found, errors, {options.window_px, options.window_px}, options.pyramid_levels,
      {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.01}, cv::OPTFLOW_USE_INITIAL_FLOW);
  return about;
}

int factor_for(const StereoPair& pair, int longest_px) {
  return (std::max(pair.left.width, pair.left.height) + longest_px - 1) / longest_px;
}

double in_full(float place, int factor) { return (static_cast<double>(place) + 0.5) * factor - 0.5; }

/// A disparity of a small copy, in its pixels.
struct Rough {
  StereoMatch match;
  int factor = 1;
  /// Number of its pixels by which the right picture was shifted to the right.
  double shift_px = 0.0;

  /// The column of a point's match in the right picture if both views agree; `times` is the ratio of the two
  /// reduced sizes.
  std::optional<float> right_x(cv::Point2f p, int times) const {
    const double scale = static_cast<double>(times) / factor;
    const int x = static_cast<int>((static_cast<double>(p.x) + 0.5) * scale),
              y = static_cast<int>((static_cast<double>(p.y) + 0.5) * scale);
    if (!match.confidence.contains(x, y) || !(match.confidence(x, y) > 0.0F)) return std::nullopt;
    const double d = static_cast<double>(match.disparity.disparity_px(x, y)) + shift_px;
    return static_cast<float>(static_cast<double>(p.x) - d / scale);
  }
};

/// The range extends well beyond the known matches, since the outermost may be wrong and near objects may
/// have none.
Result<Rough> rough_disparity(const StereoPair& pair, const std::vector<FeatureMatch>& known,
                              const CornerTrackingOptions& options, const Work& work) {
  Rough out;
  out.factor = factor_for(pair, options.disparity_longest_px);
  StereoPair small{shrunk_by(pair.left, out.factor), shrunk_by(pair.right, out.factor), {}};
  std::vector<double> disparities_px;
  disparities_px.reserve(known.size());
  for (const FeatureMatch& m : known) disparities_px.push_back((m.left_x - m.right_x) / out.factor);
  const double least = quantile_of(disparities_px, options.outer_share),
               most = quantile_of(disparities_px, 1.0 - options.outer_share);
  const double span = most - least;
  const int shift = static_cast<int>(std::floor(least - options.margin_far_share * span - options.margin_px));
  const int range = static_cast<int>(std::ceil(most + span + options.margin_near_share * small.left.width +
                                               options.margin_px)) -
                    shift;
  out.shift_px = shift;
  cv::Mat moved;
  const cv::Matx23d by(1, 0, shift, 0, 1, 0);
  cv::warpAffine(view_of(small.right), moved, by, {small.right.width, small.right.height}, cv::INTER_NEAREST,
                 cv::BORDER_REPLICATE);
  small.right = image_from(moved, small.right);
  auto found = match(small, StereoMethod::fast, {std::clamp(range, 8, small.left.width - 1)}, work);
  if (!found) return found.error();
  out.match = std::move(*found);
  return out;
}

/// Other points of similar appearance on about the same row of the right picture, as in repeated patterns;
/// best first.
std::vector<cv::Point2f> alternatives_of(const cv::Mat& left, const cv::Mat& right, cv::Point2f here,
                                         cv::Point2f about, const CornerTrackingOptions& options) {
  const int half_px = options.template_half_px, rows_px = options.band_half_px;
  const int reach = static_cast<int>(options.reach_share * left.cols);
  const cv::Point middle(cvRound(here.x), cvRound(here.y)), there(cvRound(about.x), cvRound(about.y));
  const cv::Rect window(middle.x - half_px, middle.y - half_px, 2 * half_px + 1, 2 * half_px + 1);
  const cv::Rect strip = cv::Rect(there.x - reach - half_px, there.y - rows_px - half_px,
                                  2 * (reach + half_px) + 1, 2 * (rows_px + half_px) + 1) &
                         cv::Rect({}, right.size());
  if ((window & cv::Rect({}, left.size())) != window || strip.width < window.width ||
      strip.height < window.height)
    return {};
  cv::Mat correlation;
  cv::matchTemplate(right(strip), left(window), correlation, cv::TM_CCOEFF_NORMED);
  std::vector<cv::Point2f> out;
  double best = 0.0;
  for (int i = 0; i <= options.most_alternatives; ++i) {
    double most = 0.0;
    cv::Point at;
    cv::minMaxLoc(correlation, nullptr, &most, nullptr, &at);
    best = std::max(best, most);
    if (most < options.least_correlation || most < options.least_of_best * best) break;
    out.emplace_back(static_cast<float>(strip.x + half_px + at.x),
                     static_cast<float>(strip.y + half_px + at.y));
    correlation(cv::Rect(at.x - half_px, 0, 2 * half_px + 1, correlation.rows) &
                cv::Rect({}, correlation.size())) = cv::Scalar(-1.0);
  }
  return out;
}

}  // namespace

Result<std::vector<FeatureMatch>> tracked_matches(const StereoPair& nearly_rectified,
                                                  const std::vector<FeatureMatch>& known, const Work& work,
                                                  const CornerTrackingOptions& options) {
  std::vector<FeatureMatch> out;
  if (known.empty()) return out;
  const auto rough = rough_disparity(nearly_rectified, known, options, work);
  if (!rough) return rough.error();
  const int factor = factor_for(nearly_rectified, options.longest_px);
  const cv::Mat left = grey8_of(shrunk_by(nearly_rectified.left, factor)),
                right = grey8_of(shrunk_by(nearly_rectified.right, factor));
  std::vector<cv::Point2f> here, about;
  for (const cv::Point2f& p : corners_of(left, options)) {
    const auto there = rough->right_x(p, factor);
    if (!there) continue;
    here.push_back(p);
    about.emplace_back(*there, p.y);
    const cv::Point2f first = about.back();
    for (const cv::Point2f& other : alternatives_of(left, right, p, first, options)) {
      if (cv::norm(other - first) < options.apart_px) continue;
      here.push_back(p);
      about.push_back(other);
    }
  }
  if (here.empty()) return out;
  std::vector<std::uint8_t> forth, back;
  const auto there = tracked(left, right, here, about, forth, options);
  const auto again = tracked(right, left, there, here, back, options);
  for (std::size_t i = 0; i < here.size(); ++i) {
    const bool returns =
        forth[i] != 0 && back[i] != 0 && cv::norm(again[i] - here[i]) < options.round_trip_px;
    if (!returns || cv::norm(there[i] - about[i]) > options.most_drift_px) continue;
    out.push_back({in_full(here[i].x, factor), in_full(here[i].y, factor), in_full(there[i].x, factor),
                   in_full(there[i].y, factor)});
  }
  return out;
}

}  // namespace palpable::vision
