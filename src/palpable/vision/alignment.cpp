// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/alignment.hpp"

#include "palpable/vision/camera_turns.hpp"
#include "palpable/vision/feature_matches.hpp"
#include "palpable/vision/opencv_image.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

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

Image warped(const Image& image, const Straightening& by, const cv::Matx33d& homography) {
  const cv::Matx33d back = homography.inv();
  cv::Mat from(image.height, image.width, CV_32FC2);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const cv::Point2d p = bent_back(by, back, {1.0 * x, 1.0 * y});
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
        "only {} points were found again in the other picture, too few to see whether the two are aligned",
        out.features));
  return out;
}

/// Straightens the pair unless that leaves too much; `out` is the pair as it came.
void straighten(AlignedPair& out, const TurnedCameras& cameras) {
  const double residual_px = vertical_rms_px(moved(cameras.matches, cameras.how));
  if (!(residual_px <= kTooMuch_px && residual_px <= out.residual_before_px)) {
    out.notes.push_back(
        fmt::format("the pictures could not be aligned: matched points lie {:.1f} pixels (RMS) above or "
                    "below each other, and {:.1f} at best",
                    out.residual_before_px, residual_px));
    return;
  }
  out.pair.left = warped(out.pair.left, cameras.how, cameras.how.left);
  out.pair.right = warped(out.pair.right, cameras.how, cameras.how.right);
  out.residual_px = residual_px;
  out.changed = true;
  if (out.residual_before_px > kAligned_px)
    out.notes.push_back(
        fmt::format("the pictures were aligned: matched points lay {:.1f} pixels (RMS) above or below each "
                    "other, now {:.2f}",
                    out.residual_before_px, out.residual_px));
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
          fmt::format("after rectification matched points still lie {:.1f} pixels (RMS) above or below each "
                      "other: the calibration does not belong to these pictures",
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
    const std::vector<FeatureMatch> matches = match_features(pair);
    if (work.cancelled()) return Work::interrupted();
    const double tolerance_px = feature_tolerance_px(pair.left.width, pair.left.height);
    const TurnedCameras cameras =
        turns_to_scanlines(matches, unknown_eye(pair.left.width, pair.left.height), tolerance_px, work.seed);
    const auto as_they_are = within(matches, Straightening{}, tolerance_px);
    if (vertical_rms_px(as_they_are) <= kAligned_px &&
        static_cast<double>(as_they_are.size()) >= kNearlyAll * static_cast<double>(cameras.matches.size()))
      return untouched(pair, as_they_are);
    AlignedPair out = untouched(pair, cameras.matches);
    if (out.features < kLeastFeatures) return out;
    straighten(out, cameras);
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
    const std::vector<FeatureMatch> matches = match_features(*straight);
    if (work.cancelled()) return Work::interrupted();
    // Pixels are square: one focal length serves both axes.
    const Eye eye{camera.matrix[0], camera.matrix[2], camera.matrix[5], true};
    const TurnedCameras cameras =
        turns_to_scanlines(matches, eye, feature_tolerance_px(pair.left.width, pair.left.height), work.seed);
    AlignedPair out = untouched(*straight, cameras.matches);
    out.pair.rig = StereoRig{
        {eye.focal_px, eye.focal_px, eye.cx, eye.cy, pair.left.width, pair.left.height}, moved_m, 0.0};
    if (out.features < kLeastFeatures) return out;
    const double parallax_px = parallax_rms_px(cameras.matches, eye);
    if (parallax_px < kLeastParallax_px)
      out.notes.push_back(fmt::format(
          "the camera hardly moved between the two pictures: matched points shift by {:.2f} pixels (RMS) "
          "beyond what turning explains, so their depth cannot be trusted; move it farther to the side",
          parallax_px));
    straighten(out, cameras);
    return out;
  } catch (const cv::Exception& e) {
    return failure("aligned", e);
  }
}

}  // namespace palpable::vision
