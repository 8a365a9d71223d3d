// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/any_motion.hpp"

#include "palpable/vision/stereo/problem/matrix3.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palpable::vision {
namespace {

/// Radius of the polar frame's innermost pixels, as a share of the outermost's: nothing nearer to the epipole
/// has parallax.
constexpr double kInnermost = 0.02;

cv::Matx33d camera_matrix(double focal_px, double cx, double cy) {
  return {focal_px, 0, cx, 0, focal_px, cy, 0, 0, 1};
}

/// Axes along the movement and as near to the left camera's axis as that allows: a calibrated rectification
/// (Fusiello, Trucco & Verri 2000).
cv::Matx33d axes_along(const cv::Vec3d& direction) {
  const cv::Vec3d ahead(0, 0, 1), z = cv::normalize(ahead - direction[2] * direction), y = z.cross(direction);
  return {direction[0], direction[1], direction[2], y[0], y[1], y[2], z[0], z[1], z[2]};
}

struct Bounds {
  double left, right, top, bottom;
};

Bounds bounds_of(const Matrix3& homography, PicturePoint centre) {
  Bounds box{1e30, -1e30, 1e30, -1e30};
  for (const double x : {0.0, 2.0 * centre.x})
    for (const double y : {0.0, 2.0 * centre.y}) {
      const PicturePoint p = mapped(homography, {x, y});
      box = {std::min(box.left, p.x), std::max(box.right, p.x), std::min(box.top, p.y),
             std::max(box.bottom, p.y)};
    }
  return box;
}

/// Both pictures are turned until the camera moved to the right.
AnyMotion turned(const PairMotion& motion, PicturePoint centre) {
  const MotionModel& model = motion.model;
  const cv::Matx33d axes = axes_along(model.direction), seen_as = camera_matrix(model.focal_px, 0.0, 0.0),
                    left = camera_matrix(model.focal_px, model.cx, model.cy),
                    right = camera_matrix(model.zoom * model.focal_px, model.cx, model.cy);
  AnyMotion out;
  RectifyingTransform& by = out.frame.transform;
  by.left = array_of(seen_as * axes * left.inv());
  by.right = array_of(seen_as * axes * model.left_from_right * right.inv());
  // The canvas shows the whole left picture, and what the right one shows of it beyond its left border.
  Bounds box = bounds_of(by.left, centre);
  double farthest = 0.0;
  for (const FeatureMatch& m : motion.inliers)
    farthest = std::max(farthest,
                        mapped(by.left, {m.left_x, m.left_y}).x - mapped(by.right, {m.right_x, m.right_y}).x);
  box.left = std::max(box.left - farthest, std::min(box.left, bounds_of(by.right, centre).left));
  const Matrix3 onto{1, 0, -box.left, 0, 1, -box.top, 0, 0, 1};
  by.left = product(onto, by.left);
  by.right = product(onto, by.right);
  out.frame.width = static_cast<int>(std::ceil(box.right - box.left)) + 1;
  out.frame.height = static_cast<int>(std::ceil(box.bottom - box.top)) + 1;
  return out;
}

/// The corners' radii and angles about the epipole, and whether it lies in the picture.
PolarAxes polar_axes(PicturePoint epipole, PicturePoint centre, bool forward, EpipolarFrame& frame) {
  const double w = 2.0 * centre.x, h = 2.0 * centre.y;
  const std::array<PicturePoint, 4> corners{{{0, 0}, {w, 0}, {w, h}, {0, h}}};
  const bool inside = epipole.x >= 0 && epipole.y >= 0 && epipole.x <= w && epipole.y <= h;
  const double towards = std::atan2(centre.y - epipole.y, centre.x - epipole.x);
  double farthest = 0.0, least = 0.0, most = 0.0;
  for (const PicturePoint& corner : corners) {
    const double x = corner.x - epipole.x, y = corner.y - epipole.y;
    farthest = std::max(farthest, std::hypot(x, y));
    const double angle = std::remainder(std::atan2(y, x) - towards, 2.0 * std::numbers::pi);
    least = std::min(least, angle);
    most = std::max(most, angle);
  }
  const double nearest = std::max(inside ? 0.0
                                         : std::hypot(epipole.x - std::clamp(epipole.x, 0.0, w),
                                                      epipole.y - std::clamp(epipole.y, 0.0, h)),
                                  kInnermost * farthest);
  PolarAxes axes;
  axes.epipole = epipole;
  axes.forward = forward;
  // A pixel of the frame is one of the picture at a mean radius.
  axes.scale_px = 0.5 * (farthest + nearest);
  axes.first_angle = inside ? -std::numbers::pi : towards + least;
  axes.first_radius_px = forward ? farthest : nearest;
  frame.width = static_cast<int>(std::ceil(axes.scale_px * std::log(farthest / nearest))) + 1;
  frame.height =
      static_cast<int>(std::ceil(axes.scale_px * (inside ? 2.0 * std::numbers::pi : most - least))) + 1;
  return axes;
}

/// The right picture is turned into the left one's axes; all points then move on lines through the epipole.
AnyMotion polar(const PairMotion& motion, PicturePoint centre) {
  const MotionModel& model = motion.model;
  AnyMotion out;
  out.frame.transform.right =
      array_of(camera_matrix(model.focal_px, model.cx, model.cy) * model.left_from_right *
               camera_matrix(model.zoom * model.focal_px, model.cx, model.cy).inv());
  const cv::Vec3d& d = model.direction;
  const PicturePoint epipole{model.cx + model.focal_px * d[0] / d[2],
                             model.cy + model.focal_px * d[1] / d[2]};
  out.frame.polar = polar_axes(epipole, centre, d[2] > 0.0, out.frame);
  return out;
}

/// How the camera moved, by the greatest parts of its direction.
std::string words_of(const cv::Vec3d& d) {
  std::string words;
  const auto add = [&words](const char* word) {
    words += (words.empty() ? "" : " and ") + std::string(word);
  };
  const double some = 0.35 * std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
  if (std::abs(d[2]) >= some) add(d[2] > 0.0 ? "forward" : "backward");
  if (std::abs(d[1]) >= some) add(d[1] > 0.0 ? "down" : "up");
  if (std::abs(d[0]) >= some) add(d[0] > 0.0 ? "to the right" : "to the left");
  return words;
}

}  // namespace

std::optional<PairMotion> find_any_motion(const std::vector<FeatureMatch>& matches,
                                          const SharedCamera& camera, double tolerance_px,
                                          const AnyMotionOptions& options) {
  auto motion = find_pair_motion(matches, camera, tolerance_px);
  if (motion &&
      static_cast<double>(motion->inliers.size()) < options.least_share * static_cast<double>(matches.size()))
    return std::nullopt;
  return motion;
}

bool has_parallax(const PairMotion& motion, const AnyMotionOptions& options) {
  return motion.beyond_turn >= options.least_beyond_turn;
}

bool keeps_pictures(const PairMotion& motion, int width, int height, const AnyMotionOptions& options) {
  const MotionModel& model = motion.model;
  const cv::Matx33d axes = axes_along(model.direction),
                    left = camera_matrix(model.focal_px, model.cx, model.cy),
                    right = camera_matrix(model.zoom * model.focal_px, model.cx, model.cy);
  const double kept_px = options.kept_px * width / 480.0;
  for (const Matrix3& moved :
       {array_of(left * axes * left.inv()), array_of(left * axes * model.left_from_right * right.inv())})
    for (const double x : {0.0, width - 1.0})
      for (const double y : {0.0, height - 1.0}) {
        const PicturePoint p = mapped(moved, {x, y});
        if (!(std::hypot(p.x - x, p.y - y) <= kept_px)) return false;
      }
  return true;
}

bool is_clear(const PairMotion& motion, std::size_t matches, double tolerance_px,
              const AnyMotionOptions& options) {
  const auto explained = static_cast<double>(motion.inliers.size());
  return explained >= options.clear_points &&
         explained >= options.clear_share * static_cast<double>(matches) &&
         motion.residual_px <= options.clear_residual_share * tolerance_px;
}

bool explains_more(const PairMotion& motion, std::size_t on_rows, const AnyMotionOptions& options) {
  return static_cast<double>(motion.inliers.size()) >= options.more_matches * static_cast<double>(on_rows);
}

bool offsets_explain_more(const VerticalOffsets& offsets, const PairMotion& motion,
                          const std::vector<FeatureMatch>& matches, double tolerance_px,
                          const AnyMotionOptions& options) {
  std::size_t corrected = 0;
  double squares = 0.0;
  for (const FeatureMatch& m : matches) {
    const FeatureMatch c = offsets.corrected(m);
    const double off = c.right_y - c.left_y;
    if (!(std::abs(off) <= tolerance_px)) continue;
    ++corrected;
    squares += off * off;
  }
  const auto explained = static_cast<double>(corrected),
             by_motion = static_cast<double>(motion.inliers.size());
  const double residual_px = std::sqrt(squares / std::max(1.0, explained));
  return explained >= options.more_by_offsets * by_motion ||
         (explained >= by_motion && motion.residual_px > options.nearer_by_offsets * residual_px);
}

AnyMotion frame_of_motion(const PairMotion& motion, int width, int height, const AnyMotionOptions& options) {
  const PicturePoint centre{0.5 * (width - 1), 0.5 * (height - 1)};
  const cv::Vec3d& d = motion.model.direction;
  AnyMotion out = std::abs(d[2]) <= options.polar_forward * std::hypot(d[0], d[1]) ? turned(motion, centre)
                                                                                   : polar(motion, centre);
  out.words = words_of(d);
  return out;
}

}  // namespace palpable::vision
