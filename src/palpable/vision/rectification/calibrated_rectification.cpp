// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/image/opencv_image.hpp"
#include "palpable/vision/rectification/feature_matches.hpp"
#include "palpable/vision/rectification/rectification_input.hpp"
#include "palpable/vision/rectification/rectifying_rotations.hpp"
#include "palpable/vision/rectification/stereo_rectification.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

using Options = StereoRectificationOptions;

cv::Matx33d matrix_of(const Matrix3& m) { return cv::Matx33d(m.data()); }

/// The picture of an ideal camera with the matrix `seen_as`, rotated by `rotation`, without distortion.
Image undistorted(const Image& image, const LensCamera& camera, const cv::Matx33d& rotation,
                  const cv::Matx33d& seen_as) {
  cv::Mat map_x;
  cv::Mat map_y;
  cv::initUndistortRectifyMap(matrix_of(camera.matrix), camera.distortion, rotation, seen_as,
                              {image.width, image.height}, CV_32FC1, map_x, map_y);
  cv::Mat out;
  cv::remap(view_of(image), out, map_x, map_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return image_from(out, image);
}

/// Measures the residual after a calibrated rectification, over the matches that agree on any rotation.
void measure_rectified(RectifiedPair& out, const Options& options) {
  const Image& picture = out.pair.left;
  const auto rotations = find_rectifying_rotations(
      match_features(out.pair, options.features), unknown_camera(picture.width, picture.height),
      feature_tolerance_px(picture.width, picture.height, options.features), 1, options.rotations);
  out.features = static_cast<int>(rotations.inliers.size());
  out.residual_px = vertical_rms_px(rotations.inliers);
  out.residual_before_px = std::numeric_limits<double>::quiet_NaN();
}

Result<void> check_side_by_side(const Vec3& translation_m) {
  if (std::abs(translation_m.y) > std::abs(translation_m.x))
    return invalid_input(
        "the calibration puts one camera above the other; turn the pictures and calibrate by 90 degrees");
  // p_right = R p_left + T: for a camera on the right, T.x is negative.
  if (translation_m.x >= 0.0)
    return invalid_input(
        "the calibration puts the second camera to the left of the first; exchange the pictures and the "
        "calibration's cameras");
  return {};
}

}  // namespace

Result<RectifiedPair> rectify_calibrated(const StereoPair& pair, const LensPair& cameras,
                                         const Options& options) {
  if (const auto ok = check_input(pair, options); !ok) return ok.error();
  if (const auto ok = check_side_by_side(cameras.translation_m); !ok) return ok.error();
  try {
    const cv::Size size(pair.left.width, pair.left.height);
    const Vec3& t = cameras.translation_m;
    cv::Matx33d rotation_left;
    cv::Matx33d rotation_right;
    cv::Matx34d project_left;
    cv::Matx34d project_right;
    cv::Mat q;
    cv::stereoRectify(matrix_of(cameras.left.matrix), cameras.left.distortion,
                      matrix_of(cameras.right.matrix), cameras.right.distortion, size,
                      matrix_of(cameras.rotation), cv::Vec3d(t.x, t.y, t.z), rotation_left, rotation_right,
                      project_left, project_right, q, 0, 0.0, size);
    RectifiedPair out;
    out.pair.left = undistorted(pair.left, cameras.left, rotation_left, project_left.get_minor<3, 3>(0, 0));
    out.pair.right =
        undistorted(pair.right, cameras.right, rotation_right, project_right.get_minor<3, 3>(0, 0));
    const double fx = project_left(0, 0);
    out.pair.rig =
        StereoRig{{fx, project_left(1, 1), project_left(0, 2), project_left(1, 2), size.width, size.height},
                  std::abs(project_right(0, 3)) / fx,
                  project_right(0, 2) - project_left(0, 2)};
    measure_rectified(out, options);
    out.changed = true;
    if (out.residual_px > options.most_residual_px)
      out.notes.push_back(
          fmt::format("After rectification matched points still differ vertically by {:.1f} pixels (RMS): "
                      "the calibration does not belong to these pictures.",
                      out.residual_px));
    return out;
  } catch (const cv::Exception& e) {
    return failure("rectified", e);
  }
}

Result<StereoPair> undistorted(const StereoPair& pair, const LensCamera& left, const LensCamera& right) {
  if (const auto ok = check_input(pair, {}); !ok) return ok.error();
  try {
    return StereoPair{undistorted(pair.left, left, cv::Matx33d::eye(), matrix_of(left.matrix)),
                      undistorted(pair.right, right, cv::Matx33d::eye(), matrix_of(right.matrix)),
                      {}};
  } catch (const cv::Exception& e) {
    return failure("undistorted", e);
  }
}

}  // namespace palpable::vision
