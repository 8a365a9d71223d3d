// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/tracked_matches.hpp"

#include "palpable/core/quantile.hpp"
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

constexpr int kTracked_px = 800;

/// The picture by a whole factor smaller.
Image shrunk_by(const Image& image, int factor) {
  if (factor == 1) return image;
  cv::Mat out;
  cv::resize(view_of(image), out, {image.width / factor, image.height / factor}, 0, 0, cv::INTER_AREA);
  return image_from(out, image);
}

std::vector<cv::Point2f> corners_of(const cv::Mat& grey) {
  constexpr int kMost = 800;
  constexpr double kQuality = 0.01;
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(grey, corners, kMost, kQuality, std::max(4.0, grey.cols / 80.0));
  return corners;
}

std::vector<cv::Point2f> tracked(const cv::Mat& from, const cv::Mat& to, const std::vector<cv::Point2f>& at,
                                 std::vector<cv::Point2f> about, std::vector<std::uint8_t>& found) {
  constexpr int kWindow_px = 15, kSizes = 2;
  std::vector<float> errors;
  cv::calcOpticalFlowPyrLK(from, to, at, about, found, errors, {kWindow_px, kWindow_px}, kSizes,
                           {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.01},
                           cv::OPTFLOW_USE_INITIAL_FLOW);
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
  /// By so many of its pixels the right picture was moved to the right.
  double shift_px = 0.0;

  /// Where the point of the pictures `times` smaller lies on its row in the right one, where both views
  /// agree.
  std::optional<float> right_x(cv::Point2f p, int times) const {
    const double scale = static_cast<double>(times) / factor;
    const int x = static_cast<int>((static_cast<double>(p.x) + 0.5) * scale),
              y = static_cast<int>((static_cast<double>(p.y) + 0.5) * scale);
    if (!match.confidence.contains(x, y) || !(match.confidence(x, y) > 0.0F)) return std::nullopt;
    const double d = static_cast<double>(match.disparity.disparity_px(x, y)) + shift_px;
    return static_cast<float>(static_cast<double>(p.x) - d / scale);
  }
};

/// Searched well beyond the known matches, the outermost few of which may be wrong: nearer things may have
/// none.
Result<Rough> rough_disparity(const StereoPair& pair, const std::vector<FeatureMatch>& known,
                              const Work& work) {
  constexpr int kLongest_px = 400;
  constexpr double kBehind = 0.25, kBefore = 0.12, kMargin_px = 4.0, kFew = 0.05;
  Rough out;
  out.factor = factor_for(pair, kLongest_px);
  StereoPair small{shrunk_by(pair.left, out.factor), shrunk_by(pair.right, out.factor), {}};
  std::vector<double> disparities_px;
  disparities_px.reserve(known.size());
  for (const FeatureMatch& m : known) disparities_px.push_back((m.left_x - m.right_x) / out.factor);
  const double least = quantile_of(disparities_px, kFew), most = quantile_of(disparities_px, 1.0 - kFew);
  const double span = most - least;
  const int shift = static_cast<int>(std::floor(least - kBehind * span - kMargin_px));
  const int range =
      static_cast<int>(std::ceil(most + span + kBefore * small.left.width + kMargin_px)) - shift;
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

/// Where else on about the same row the right picture looks like the left one around `here`, as a pattern
/// that repeats itself does: up to kMost places, best first, within kReach of the picture's width about
/// `about`.
std::vector<cv::Point2f> look_alikes(const cv::Mat& left, const cv::Mat& right, cv::Point2f here,
                                     cv::Point2f about) {
  constexpr int kHalf_px = 9, kRows_px = 4, kMost = 4;
  constexpr double kReach = 0.2, kAlike = 0.75, kNearlyBest = 0.85;
  const int reach = static_cast<int>(kReach * left.cols);
  const cv::Point middle(cvRound(here.x), cvRound(here.y)), there(cvRound(about.x), cvRound(about.y));
  const cv::Rect window(middle.x - kHalf_px, middle.y - kHalf_px, 2 * kHalf_px + 1, 2 * kHalf_px + 1);
  const cv::Rect strip = cv::Rect(there.x - reach - kHalf_px, there.y - kRows_px - kHalf_px,
                                  2 * (reach + kHalf_px) + 1, 2 * (kRows_px + kHalf_px) + 1) &
                         cv::Rect({}, right.size());
  if ((window & cv::Rect({}, left.size())) != window || strip.width < window.width ||
      strip.height < window.height)
    return {};
  cv::Mat likeness;
  cv::matchTemplate(right(strip), left(window), likeness, cv::TM_CCOEFF_NORMED);
  std::vector<cv::Point2f> out;
  double best = 0.0;
  for (int i = 0; i <= kMost; ++i) {
    double most = 0.0;
    cv::Point at;
    cv::minMaxLoc(likeness, nullptr, &most, nullptr, &at);
    best = std::max(best, most);
    if (most < kAlike || most < kNearlyBest * best) break;
    out.emplace_back(static_cast<float>(strip.x + kHalf_px + at.x),
                     static_cast<float>(strip.y + kHalf_px + at.y));
    likeness(cv::Rect(at.x - kHalf_px, 0, 2 * kHalf_px + 1, likeness.rows) & cv::Rect({}, likeness.size())) =
        cv::Scalar(-1.0);
  }
  return out;
}

}  // namespace

Result<std::vector<FeatureMatch>> tracked_matches(const StereoPair& nearly_aligned,
                                                  const std::vector<FeatureMatch>& known, const Work& work) {
  constexpr double kLeadsBack_px = 0.3, kStays_px = 12.0, kApart_px = 8.0;
  std::vector<FeatureMatch> out;
  if (known.empty()) return out;
  const auto rough = rough_disparity(nearly_aligned, known, work);
  if (!rough) return rough.error();
  const int factor = factor_for(nearly_aligned, kTracked_px);
  const cv::Mat left = grey8_of(shrunk_by(nearly_aligned.left, factor)),
                right = grey8_of(shrunk_by(nearly_aligned.right, factor));
  std::vector<cv::Point2f> here, about;
  for (const cv::Point2f& p : corners_of(left)) {
    const auto there = rough->right_x(p, factor);
    if (!there) continue;
    here.push_back(p);
    about.emplace_back(*there, p.y);
    const cv::Point2f first = about.back();
    for (const cv::Point2f& other : look_alikes(left, right, p, first)) {
      if (cv::norm(other - first) < kApart_px) continue;
      here.push_back(p);
      about.push_back(other);
    }
  }
  if (here.empty()) return out;
  std::vector<std::uint8_t> forth, back;
  const auto there = tracked(left, right, here, about, forth);
  const auto again = tracked(right, left, there, here, back);
  for (std::size_t i = 0; i < here.size(); ++i) {
    const bool leads_back = forth[i] != 0 && back[i] != 0 && cv::norm(again[i] - here[i]) < kLeadsBack_px;
    if (!leads_back || cv::norm(there[i] - about[i]) > kStays_px) continue;
    out.push_back({in_full(here[i].x, factor), in_full(here[i].y, factor), in_full(there[i].x, factor),
                   in_full(there[i].y, factor)});
  }
  return out;
}

}  // namespace palpable::vision
