// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/alignment.hpp"

#include "palpable/vision/feature_matches.hpp"
#include "palpable/vision/opencv_image.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

constexpr double kAligned_px = 0.5;
constexpr double kTooMuch_px = 2.0;

Result<void> same_size(const StereoPair& pair) {
  if (pair.left.width == pair.right.width && pair.left.height == pair.right.height) return {};
  return invalid_input(
      fmt::format("the two pictures of a stereo pair must have the same size, but the left one has "
                  "{}x{} and the right one {}x{} pixels",
                  pair.left.width, pair.left.height, pair.right.width, pair.right.height));
}

cv::Matx33d matrix_of(const std::array<double, 9>& m) { return cv::Matx33d(m.data()); }

cv::Mat warped(const Image& image, const cv::Matx33d& homography) {
  cv::Mat out;
  cv::warpPerspective(view_of(image), out, homography, {image.width, image.height}, cv::INTER_LINEAR,
                      cv::BORDER_REPLICATE);
  return out;
}

/// Left turned about y and z, right about x, y and z (radians), and the logarithm of the focal length over
/// the sum of the picture's sides: what two cameras' alignment can depend on (Fusiello & Irsara 2011).
using Turns = cv::Vec<double, 6>;

cv::Matx33d turned(double about_x, double about_y, double about_z) {
  cv::Matx33d r;
  cv::Rodrigues(cv::Vec3d(about_x, about_y, about_z), r);
  return r;
}

struct Homographies {
  cv::Matx33d left;
  cv::Matx33d right;
};

Homographies homographies_of(const Turns& turns, int width, int height) {
  const double focal = std::exp(turns[5]) * (width + height);
  const cv::Matx33d camera(focal, 0, (width - 1) / 2.0, 0, focal, (height - 1) / 2.0, 0, 0, 1);
  const cv::Matx33d back = camera.inv();
  return {camera * turned(0, turns[0], turns[1]) * back,
          camera * turned(turns[2], turns[3], turns[4]) * back};
}

double mapped_y(const cv::Matx33d& h, double x, double y) {
  const cv::Vec3d p = h * cv::Vec3d(x, y, 1.0);
  return p[1] / p[2];
}

/// One residual a match, y_left - y_right after turning; then a weak wish for small turns and a usual focal
/// length, which decides where the matches do not.
std::vector<double> residuals(const Turns& turns, const std::vector<FeatureMatch>& matches, int width,
                              int height) {
  constexpr double kWish_px = 3.0;
  const Homographies h = homographies_of(turns, width, height);
  std::vector<double> out;
  out.reserve(matches.size() + 6);
  for (const FeatureMatch& m : matches)
    out.push_back(mapped_y(h.left, m.left_x, m.left_y) - mapped_y(h.right, m.right_x, m.right_y));
  for (int i = 0; i < 6; ++i) out.push_back(kWish_px * turns[i]);
  return out;
}

double squares_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return sum;
}

/// Levenberg-Marquardt with differences for derivatives: six unknowns do not need more.
Turns best_turns(const std::vector<FeatureMatch>& matches, int width, int height) {
  constexpr double kStep = 1e-6;
  Turns turns = Turns::all(0.0);
  std::vector<double> now = residuals(turns, matches, width, height);
  double damping = 1e-3;
  for (int i = 0; i < 60; ++i) {
    cv::Matx66d normal = cv::Matx66d::zeros();
    Turns right = Turns::all(0.0);
    std::vector<Turns> rows(now.size());
    for (int k = 0; k < 6; ++k) {
      Turns moved = turns;
      moved[k] += kStep;
      const std::vector<double> then = residuals(moved, matches, width, height);
      for (std::size_t r = 0; r < now.size(); ++r) rows[r][k] = (then[r] - now[r]) / kStep;
    }
    for (std::size_t r = 0; r < now.size(); ++r) {
      normal += rows[r] * rows[r].t();
      right -= now[r] * rows[r];
    }
    for (int k = 0; k < 6; ++k) normal(k, k) *= 1.0 + damping;
    const Turns candidate = turns + Turns(normal.solve(right, cv::DECOMP_SVD));
    const std::vector<double> then = residuals(candidate, matches, width, height);
    const double gain = squares_of(now) - squares_of(then);
    if (gain > 0.0) {
      turns = candidate;
      now = then;
      damping = std::max(1e-9, damping / 4.0);
      if (gain < 1e-9 * squares_of(now)) break;
    } else {
      damping *= 8.0;
      if (damping > 1e9) break;
    }
  }
  return turns;
}

}  // namespace

Result<AlignedPair> rectify_calibrated(const StereoPair& pair, const LensPair& cameras) {
  if (const auto ok = same_size(pair); !ok) return ok.error();
  try {
    const cv::Size size(pair.left.width, pair.left.height);
    const cv::Matx33d left = matrix_of(cameras.left.matrix);
    const cv::Matx33d right = matrix_of(cameras.right.matrix);
    const cv::Vec3d translation(cameras.translation_m.x, cameras.translation_m.y, cameras.translation_m.z);
    cv::Matx33d turn_left;
    cv::Matx33d turn_right;
    cv::Matx34d project_left;
    cv::Matx34d project_right;
    cv::Mat q;
    cv::stereoRectify(left, cameras.left.distortion, right, cameras.right.distortion, size,
                      matrix_of(cameras.rotation), translation, turn_left, turn_right, project_left,
                      project_right, q, 0, 0.0, size);
    if (std::abs(project_right(1, 3)) > std::abs(project_right(0, 3)))
      return invalid_input(
          "the calibration puts one camera above the other; turn the pictures by 90 degrees");
    const auto straightened = [&](const Image& image, const cv::Matx33d& camera,
                                  const std::vector<double>& lens, const cv::Matx33d& turn,
                                  const cv::Matx34d& project) {
      cv::Mat map_x;
      cv::Mat map_y;
      cv::initUndistortRectifyMap(camera, lens, turn, project.get_minor<3, 3>(0, 0), size, CV_32FC1, map_x,
                                  map_y);
      cv::Mat out;
      cv::remap(view_of(image), out, map_x, map_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
      return image_from(out, image);
    };
    AlignedPair out;
    out.pair.left = straightened(pair.left, left, cameras.left.distortion, turn_left, project_left);
    out.pair.right = straightened(pair.right, right, cameras.right.distortion, turn_right, project_right);
    const double fx = project_left(0, 0);
    out.pair.rig =
        StereoRig{{fx, project_left(1, 1), project_left(0, 2), project_left(1, 2), size.width, size.height},
                  std::abs(project_right(0, 3)) / fx,
                  project_right(0, 2) - project_left(0, 2)};
    const auto matches = match_features(out.pair);
    out.residual_before_px = vertical_rms_px(match_features(pair));
    out.residual_px = vertical_rms_px(matches);
    out.features = static_cast<int>(matches.size());
    out.changed = true;
    if (out.residual_px > kTooMuch_px)
      out.notes.push_back(
          fmt::format("after rectification matched points still lie {:.1f} pixels (RMS) above or below each "
                      "other: the calibration does not belong to these pictures",
                      out.residual_px));
    return out;
  } catch (const cv::Exception& e) {
    return Error{ErrorCode::failed, std::string("the pair could not be rectified: ") + e.what(), {}};
  }
}

Result<AlignedPair> align_uncalibrated(const StereoPair& pair, const Work& work) {
  if (const auto ok = same_size(pair); !ok) return ok.error();
  constexpr int kLeastFeatures = 20;
  try {
    work.report(0.0, "looking for the same points in both pictures");
    AlignedPair out;
    out.pair = pair;
    const std::vector<FeatureMatch> matches = match_features(pair);
    if (work.cancelled()) return Work::interrupted();
    out.features = static_cast<int>(matches.size());
    out.residual_before_px = vertical_rms_px(matches);
    out.residual_px = out.residual_before_px;
    if (out.features < kLeastFeatures) {
      out.notes.push_back(
          fmt::format("only {} points were found in both pictures, too few to align them", out.features));
      return out;
    }
    if (out.residual_px <= kAligned_px) return out;
    const int width = pair.left.width;
    const int height = pair.left.height;
    const Turns turns = best_turns(matches, width, height);
    const Homographies h = homographies_of(turns, width, height);
    std::vector<FeatureMatch> after = matches;
    for (FeatureMatch& m : after) {
      m.left_y = mapped_y(h.left, m.left_x, m.left_y);
      m.right_y = mapped_y(h.right, m.right_x, m.right_y);
    }
    const double residual = vertical_rms_px(after);
    if (residual > kTooMuch_px || residual > out.residual_before_px) {
      out.notes.push_back(
          fmt::format("the pictures could not be aligned: matched points lie {:.1f} pixels (RMS) above or "
                      "below each other, and {:.1f} at best",
                      out.residual_before_px, residual));
      return out;
    }
    out.pair.left = image_from(warped(pair.left, h.left), pair.left);
    out.pair.right = image_from(warped(pair.right, h.right), pair.right);
    out.pair.rig.reset();
    out.residual_px = residual;
    out.changed = true;
    out.notes.push_back(
        fmt::format("the pictures were aligned: matched points lay {:.1f} pixels (RMS) above or below each "
                    "other, now {:.2f}",
                    out.residual_before_px, out.residual_px));
    return out;
  } catch (const cv::Exception& e) {
    return Error{ErrorCode::failed, std::string("the pair could not be aligned: ") + e.what(), {}};
  }
}

}  // namespace palpable::vision
