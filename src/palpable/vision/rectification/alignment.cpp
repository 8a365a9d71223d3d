// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/alignment.hpp"

#include "palpable/vision/image/opencv_image.hpp"
#include "palpable/vision/rectification/camera_turns.hpp"
#include "palpable/vision/rectification/feature_matches.hpp"
#include "palpable/vision/rectification/rolling_rows.hpp"
#include "palpable/vision/rectification/tracked_matches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

constexpr double kAligned_px = 0.5;
constexpr double kTooMuch_px = 2.0;
constexpr int kLeastFeatures = 20;
/// A pair is aligned where turning would win hardly any match.
constexpr double kNearlyAll = 0.9;

Result<void> same_size(const StereoPair& pair) {
  if (pair.left.width == pair.right.width && pair.left.height == pair.right.height) return {};
  return invalid_input(
      fmt::format("the two pictures of a stereo pair must have the same size, but the left one has "
                  "{}x{} and the right one {}x{} pixels",
                  pair.left.width, pair.left.height, pair.right.width, pair.right.height));
}

Error failure(const char* what, const cv::Exception& e) {
  return {ErrorCode::failed, fmt::format("the pair could not be {}: {}", what, e.what()), {}};
}

cv::Matx33d matrix_of(const std::array<double, 9>& m) { return cv::Matx33d(m.data()); }

/// The picture as `homography` straightens it, its rows evened where they roll.
Image warped(const Image& image, const Straightening& by, const cv::Matx33d& homography,
             const RollingRows* rolling = nullptr) {
  const cv::Matx33d back = homography.inv();
  cv::Mat from(image.height, image.width, CV_32FC2);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double lower = rolling != nullptr ? rolling->offset_px(x, y) : 0.0;
      const cv::Point2d p = bent_back(by, back, {1.0 * x, y + lower});
      from.at<cv::Point2f>(y, x) = {static_cast<float>(p.x), static_cast<float>(p.y)};
    }
  cv::Mat out;
  cv::remap(view_of(image), out, from, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return image_from(out, image);
}

/// The picture as a camera of matrix `seen_as`, turned by `turn`, without distortion, would have seen it.
Image straightened(const Image& image, const LensCamera& camera, const cv::Matx33d& turn,
                   const cv::Matx33d& seen_as) {
  cv::Mat map_x;
  cv::Mat map_y;
  cv::initUndistortRectifyMap(matrix_of(camera.matrix), camera.distortion, turn, seen_as,
                              {image.width, image.height}, CV_32FC1, map_x, map_y);
  cv::Mat out;
  cv::remap(view_of(image), out, map_x, map_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return image_from(out, image);
}

AlignedPair untouched(const StereoPair& pair, const std::vector<FeatureMatch>& matches) {
  AlignedPair out;
  out.pair = pair;
  out.features = static_cast<int>(matches.size());
  out.residual_before_px = vertical_rms_px(matches);
  out.residual_px = out.residual_before_px;
  if (out.features < kLeastFeatures)
    out.notes.push_back(fmt::format(
        "Only {} points were found again in the other picture, too few to see whether the two are aligned.",
        out.features));
  return out;
}

/// How a pair is brought to common scanlines: its cameras are turned; or, where no turn explains what the
/// matches say, the right picture's rows are moved up and down.
struct Way {
  TurnedCameras cameras;
  std::optional<RollingRows> rolling;
  /// The greatest offset of a rolling picture.
  double greatest_px = 0.0;

  /// The matches that agree, as they lie then.
  std::vector<FeatureMatch> straight_matches() const {
    std::vector<FeatureMatch> straight = moved(cameras.matches, cameras.how);
    if (rolling)
      for (FeatureMatch& m : straight) m = rolling->evened(m);
    return straight;
  }
  double residual_px() const { return vertical_rms_px(straight_matches()); }
};

/// What the matches say of a pair.
struct Evidence {
  std::vector<FeatureMatch> matches;
  Way way;
  /// Of the corners tracked last, so many lay on common rows already.
  double share = 0.0;
};

/// Turns, unless moving rows explains far more: then the left picture stays as it is.
Way way_of(const std::vector<FeatureMatch>& matches, TurnedCameras turns, const Image& picture) {
  const double tolerance_px = feature_tolerance_px(picture.width, picture.height);
  const RollingGain gain = rolling_gain(matches, picture.width, picture.height, tolerance_px);
  auto rolling = gain.worth_it(turns.matches.size(), vertical_rms_px(moved(turns.matches, turns.how)))
                     ? RollingRows::through(matches, picture.width, picture.height)
                     : std::nullopt;
  if (!rolling) return {std::move(turns), {}, 0.0};
  TurnedCameras none;
  for (const FeatureMatch& m : matches)
    if (const FeatureMatch evened = rolling->evened(m);
        std::abs(evened.right_y - evened.left_y) <= tolerance_px)
      none.matches.push_back(m);
  return {std::move(none), std::move(rolling), gain.greatest_px};
}

StereoPair straightened(const StereoPair& pair, const Way& way) {
  const Straightening& how = way.cameras.how;
  return {warped(pair.left, how, how.left),
          warped(pair.right, how, how.right, way.rolling ? &*way.rolling : nullptr),
          {}};
}

/// The match in the pictures before they were straightened.
FeatureMatch as_it_came(FeatureMatch m, const Way& way) {
  const Straightening& how = way.cameras.how;
  if (way.rolling) m.right_y += way.rolling->offset_px(m.right_x, m.right_y);
  const cv::Point2d p = bent_back(how, how.left.inv(), {m.left_x, m.left_y}),
                    q = bent_back(how, how.right.inv(), {m.right_x, m.right_y});
  return {p.x, p.y, q.x, q.y};
}

double share_on_rows(const std::vector<FeatureMatch>& matches, double tolerance_px) {
  const Straightening none;
  return static_cast<double>(within(matches, none, tolerance_px).size()) /
         static_cast<double>(std::max<std::size_t>(1, one_a_place(matches, none).size()));
}

/// Once features have made the pictures about straight, corners are tracked between them: features alone are
/// few, and none lie where a pattern repeats itself.
Result<Evidence> evidence_from(const StereoPair& pair, const Eye& eye,
                               const std::vector<FeatureMatch>& features, TurnedCameras first,
                               const Work& work) {
  constexpr int kRounds = 2;
  const double tolerance_px = feature_tolerance_px(pair.left.width, pair.left.height);
  Evidence out{features, way_of(features, std::move(first), pair.left)};
  for (int round = 0; round < kRounds; ++round) {
    if (out.way.cameras.matches.size() < kLeastFeatures) return out;
    if (work.cancelled()) return Work::interrupted();
    const auto tracked = tracked_matches(straightened(pair, out.way), out.way.straight_matches(), work);
    if (!tracked) return tracked.error();
    out.share = share_on_rows(*tracked, 0.5 * tolerance_px);
    out.matches = features;
    for (const FeatureMatch& m : *tracked) out.matches.push_back(as_it_came(m, out.way));
    TurnedCameras turns = turns_to_scanlines(out.matches, eye, tolerance_px, work.seed);
    out.matches = one_a_place(out.matches, turns.how);
    out.way = way_of(out.matches, std::move(turns), pair.left);
    if (out.share > kNearlyAll) break;
  }
  return out;
}

/// Where features are few, a turn that some of them agree on by chance leads corners astray. Where most
/// corners say so, it begins once more with what all features agree on roughly, and more matches decide.
Result<Evidence> evidence_of(const StereoPair& pair, const Eye& eye,
                             const std::vector<FeatureMatch>& features, TurnedCameras first,
                             const Work& work) {
  constexpr double kMost = 0.6;
  Result<Evidence> out = evidence_from(pair, eye, features, std::move(first), work);
  if (!out || out->share > kMost) return out;
  const double tolerance_px = feature_tolerance_px(pair.left.width, pair.left.height);
  Result<Evidence> again =
      evidence_from(pair, eye, features, rough_turns(features, eye, tolerance_px, work.seed), work);
  if (!again) return again;
  return again->way.cameras.matches.size() > out->way.cameras.matches.size() ? again : out;
}

/// Straightens the pair unless that leaves too much; `out` is the pair as it came.
void straighten(AlignedPair& out, const Evidence& evidence) {
  const Way& way = evidence.way;
  const double residual_px = way.residual_px();
  if (!(residual_px <= kTooMuch_px && residual_px <= out.residual_before_px)) {
    out.notes.push_back(
        fmt::format("The pictures could not be aligned: matched points lie {:.1f} pixels (RMS) above or "
                    "below each other, and {:.1f} at best.",
                    out.residual_before_px, residual_px));
    return;
  }
  StereoPair straight = straightened(out.pair, way);
  out.pair.left = std::move(straight.left);
  out.pair.right = std::move(straight.right);
  out.residual_px = residual_px;
  out.changed = true;
  if (out.residual_before_px <= kAligned_px) return;
  out.notes.push_back(
      fmt::format("The pictures were aligned: matched points lay {:.1f} pixels (RMS) above or below each "
                  "other, now {:.2f} over {} of {} points.",
                  out.residual_before_px, out.residual_px, out.features, evidence.matches.size()));
  if (way.rolling)
    out.notes.push_back(
        fmt::format("The pictures' rows roll against each other by up to {:.1f} pixels, which no turn of a "
                    "camera explains "
                    "(a rolling shutter, a loose scan): the right one's were moved onto the left one's.",
                    way.greatest_px));
}

/// What is left after a calibration's rectification, over the matches that agree on any turn at all.
void measure_rectified(AlignedPair& out) {
  const Image& picture = out.pair.left;
  const auto cameras =
      turns_to_scanlines(match_features(out.pair), unknown_eye(picture.width, picture.height),
                         feature_tolerance_px(picture.width, picture.height), 1);
  out.features = static_cast<int>(cameras.matches.size());
  out.residual_px = vertical_rms_px(cameras.matches);
  out.residual_before_px = std::numeric_limits<double>::quiet_NaN();
}

Result<void> right_of_each_other(const Vec3& translation_m) {
  if (std::abs(translation_m.y) > std::abs(translation_m.x))
    return invalid_input(
        "the calibration puts one camera above the other; turn the pictures and calibrate by 90 degrees");
  // p_right = R p_left + T: a camera to the right sees everything moved to the left.
  if (translation_m.x >= 0.0)
    return invalid_input(
        "the calibration puts the second camera to the left of the first; exchange the pictures and the "
        "calibration's cameras");
  return {};
}

}  // namespace

LensCamera usual_camera(int width, int height) {
  const double focal_px = 0.5 * width / std::tan(0.5 * 65.0 * std::numbers::pi / 180.0);
  return {{focal_px, 0, 0.5 * (width - 1), 0, focal_px, 0.5 * (height - 1), 0, 0, 1}, {}};
}

Result<AlignedPair> rectify_calibrated(const StereoPair& pair, const LensPair& cameras) {
  if (const auto ok = same_size(pair); !ok) return ok.error();
  if (const auto ok = right_of_each_other(cameras.translation_m); !ok) return ok.error();
  try {
    const cv::Size size(pair.left.width, pair.left.height);
    const Vec3& t = cameras.translation_m;
    cv::Matx33d turn_left;
    cv::Matx33d turn_right;
    cv::Matx34d project_left;
    cv::Matx34d project_right;
    cv::Mat q;
    cv::stereoRectify(matrix_of(cameras.left.matrix), cameras.left.distortion,
                      matrix_of(cameras.right.matrix), cameras.right.distortion, size,
                      matrix_of(cameras.rotation), cv::Vec3d(t.x, t.y, t.z), turn_left, turn_right,
                      project_left, project_right, q, 0, 0.0, size);
    AlignedPair out;
    out.pair.left = straightened(pair.left, cameras.left, turn_left, project_left.get_minor<3, 3>(0, 0));
    out.pair.right = straightened(pair.right, cameras.right, turn_right, project_right.get_minor<3, 3>(0, 0));
    const double fx = project_left(0, 0);
    out.pair.rig =
        StereoRig{{fx, project_left(1, 1), project_left(0, 2), project_left(1, 2), size.width, size.height},
                  std::abs(project_right(0, 3)) / fx,
                  project_right(0, 2) - project_left(0, 2)};
    measure_rectified(out);
    out.changed = true;
    if (out.residual_px > kTooMuch_px)
      out.notes.push_back(
          fmt::format("After rectification matched points still lie {:.1f} pixels (RMS) above or below each "
                      "other: the calibration does not belong to these pictures.",
                      out.residual_px));
    return out;
  } catch (const cv::Exception& e) {
    return failure("rectified", e);
  }
}

Result<AlignedPair> align_uncalibrated(const StereoPair& pair, const Work& work) {
  if (const auto ok = same_size(pair); !ok) return ok.error();
  try {
    work.report(0.0, "looking for the same points in both pictures");
    const std::vector<FeatureMatch> features = match_features(pair);
    if (work.cancelled()) return Work::interrupted();
    const double tolerance_px = feature_tolerance_px(pair.left.width, pair.left.height);
    const Eye eye = unknown_eye(pair.left.width, pair.left.height);
    const auto as_they_are = within(features, Straightening{}, tolerance_px);
    TurnedCameras first = turns_to_scanlines(features, eye, tolerance_px, work.seed);
    if (vertical_rms_px(as_they_are) <= kAligned_px &&
        static_cast<double>(as_they_are.size()) >= kNearlyAll * static_cast<double>(first.matches.size()))
      return untouched(pair, as_they_are);
    const auto evidence = evidence_of(pair, eye, features, std::move(first), work);
    if (!evidence) return evidence.error();
    AlignedPair out = untouched(pair, evidence->way.cameras.matches);
    if (out.features < kLeastFeatures) return out;
    straighten(out, *evidence);
    if (out.changed) out.pair.rig.reset();
    return out;
  } catch (const cv::Exception& e) {
    return failure("aligned", e);
  }
}

Result<StereoPair> undistorted(const StereoPair& pair, const LensCamera& left, const LensCamera& right) {
  if (const auto ok = same_size(pair); !ok) return ok.error();
  try {
    return StereoPair{straightened(pair.left, left, cv::Matx33d::eye(), matrix_of(left.matrix)),
                      straightened(pair.right, right, cv::Matx33d::eye(), matrix_of(right.matrix)),
                      {}};
  } catch (const cv::Exception& e) {
    return failure("freed of the lens's distortion", e);
  }
}

Result<AlignedPair> align_moved(const StereoPair& pair, const LensCamera& camera, double moved_m,
                                const Work& work) {
  // Below this, matched points move by no more than features are found to: there is no depth to see.
  constexpr double kLeastParallax_px = 1.0;
  auto straight = undistorted(pair, camera, camera);
  if (!straight) return straight.error();
  try {
    work.report(0.0, "looking for the same points in both pictures");
    // Pixels are square: one focal length serves both axes.
    const Eye eye{camera.matrix[0], camera.matrix[2], camera.matrix[5], true};
    const std::vector<FeatureMatch> features = match_features(*straight);
    if (work.cancelled()) return Work::interrupted();
    TurnedCameras first =
        turns_to_scanlines(features, eye, feature_tolerance_px(pair.left.width, pair.left.height), work.seed);
    const auto evidence = evidence_of(*straight, eye, features, std::move(first), work);
    if (!evidence) return evidence.error();
    AlignedPair out = untouched(*straight, evidence->way.cameras.matches);
    out.pair.rig = StereoRig{
        {eye.focal_px, eye.focal_px, eye.cx, eye.cy, pair.left.width, pair.left.height}, moved_m, 0.0};
    if (out.features < kLeastFeatures) return out;
    const double parallax_px = parallax_rms_px(evidence->way.cameras.matches, eye);
    if (parallax_px < kLeastParallax_px)
      out.notes.push_back(fmt::format(
          "The camera hardly moved between the two pictures: matched points shift by {:.2f} pixels (RMS) "
          "beyond what turning explains, so their depth cannot be trusted; move it farther to the side.",
          parallax_px));
    straighten(out, *evidence);
    return out;
  } catch (const cv::Exception& e) {
    return failure("aligned", e);
  }
}

}  // namespace palpable::vision
