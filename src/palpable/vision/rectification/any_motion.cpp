// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/any_motion.hpp"

#include "palpable/vision/rectification/rectifying_rotations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace palpable::vision {
namespace {

constexpr double kPerDegree = std::numbers::pi / 180.0;
/// A turn this near to a quarter is one, which keeps the pixels.
constexpr double kQuarterWithin = 12.0 * kPerDegree;
/// Radius of the polar frame's innermost pixels, as a share of the outermost's: nothing nearer to the epipole
/// has parallax.
constexpr double kInnermost = 0.02;

/// Turns a picture's pixels about its centre, enlarges them and puts the centre at the canvas'.
Matrix3 turn_onto(double angle, double scale, PicturePoint centre, PicturePoint canvas_centre) {
  const double c = scale * std::cos(angle), s = scale * std::sin(angle);
  return {c, -s, canvas_centre.x - c * centre.x + s * centre.y,
          s, c,  canvas_centre.y - s * centre.x - c * centre.y,
          0, 0,  1};
}

double near_quarter(double angle) {
  const double quarter = 0.5 * std::numbers::pi * std::round(angle / (0.5 * std::numbers::pi));
  return std::abs(angle - quarter) <= kQuarterWithin ? quarter : angle;
}

/// The angle by which the right picture is rolled beside the left one.
double roll_of(const Matrix3& left_from_right) {
  return std::atan2(left_from_right[3] - left_from_right[1], left_from_right[0] + left_from_right[4]);
}

double rms_off_rows(const EpipolarFrame& frame, const std::vector<FeatureMatch>& matches) {
  double squares = 0.0;
  for (const FeatureMatch& m : matches) {
    const double off = frame_from_picture(frame, frame.transform.left, {m.left_x, m.left_y}).y -
                       frame_from_picture(frame, frame.transform.right, {m.right_x, m.right_y}).y;
    // Rows of a polar frame are periodic.
    const double period =
        frame.polar ? 2.0 * std::numbers::pi * frame.polar->scale_px : std::numeric_limits<double>::max();
    squares += std::pow(std::remainder(off, period), 2);
  }
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, matches.size())));
}

/// Both pictures are turned until the camera moved to the right, then rectified by rotations.
std::optional<AnyMotion> turned(const PairMotion& motion, const std::vector<FeatureMatch>& matches,
                                PicturePoint centre, double tolerance_px, std::uint64_t seed) {
  const double angle = near_quarter(-std::atan2(motion.direction.y, motion.direction.x));
  const double c = std::abs(std::cos(angle)), s = std::abs(std::sin(angle));
  AnyMotion out;
  out.frame.width = static_cast<int>(std::ceil(2.0 * (c * centre.x + s * centre.y) - 1e-6)) + 1;
  out.frame.height = static_cast<int>(std::ceil(2.0 * (s * centre.x + c * centre.y) - 1e-6)) + 1;
  const PicturePoint canvas{0.5 * (out.frame.width - 1), 0.5 * (out.frame.height - 1)};
  const Matrix3 left = turn_onto(angle, 1.0, centre, canvas),
                right = turn_onto(near_quarter(angle + roll_of(motion.left_from_right)), 1.0 / motion.zoom,
                                  centre, canvas);
  std::vector<FeatureMatch> turned;
  for (const FeatureMatch& m : matches) {
    const PicturePoint p = mapped(left, {m.left_x, m.left_y}), q = mapped(right, {m.right_x, m.right_y});
    turned.push_back({p.x, p.y, q.x, q.y});
  }
  const RectifyingRotations found = find_rectifying_rotations(
      turned, unknown_camera(out.frame.width, out.frame.height), tolerance_px, seed);
  if (found.inliers.empty()) return std::nullopt;
  // Distortion about the centre is the same before and after a turn about it.
  out.frame.transform = {product(found.transform.left, left), product(found.transform.right, right),
                         found.transform.distortion, centre.x, centre.y};
  const Matrix3 left_back = inverse(left), right_back = inverse(right);
  for (const FeatureMatch& m : found.inliers) {
    const PicturePoint p = mapped(left_back, {m.left_x, m.left_y}),
                       q = mapped(right_back, {m.right_x, m.right_y});
    out.inliers.push_back({p.x, p.y, q.x, q.y});
  }
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
  AnyMotion out;
  const Matrix3 camera{motion.focal_px, 0, centre.x, 0, motion.focal_px, centre.y, 0, 0, 1};
  Matrix3 other = camera;
  other[0] = other[4] = motion.zoom * motion.focal_px;
  out.frame.transform.right = product(camera, product(motion.left_from_right, inverse(other)));
  const Vec3& d = motion.direction;
  const PicturePoint epipole{centre.x + motion.focal_px * d.x / d.z, centre.y + motion.focal_px * d.y / d.z};
  out.frame.polar = polar_axes(epipole, centre, d.z > 0.0, out.frame);
  out.inliers = motion.inliers;
  return out;
}

/// How the camera moved, by the greatest parts of its direction.
std::string words_of(const Vec3& d) {
  std::string words;
  const auto add = [&words](const char* word) {
    words += (words.empty() ? "" : " and ") + std::string(word);
  };
  const double some = 0.35 * std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  if (std::abs(d.z) >= some) add(d.z > 0.0 ? "forward" : "backward");
  if (std::abs(d.y) >= some) add(d.y > 0.0 ? "down" : "up");
  if (std::abs(d.x) >= some) add(d.x > 0.0 ? "to the right" : "to the left");
  return words;
}

}  // namespace

bool is_sideways(const PairMotion& motion, const AnyMotionOptions& options) {
  const Vec3& d = motion.direction;
  const double across = std::hypot(d.x, d.y);
  return std::abs(d.y) <= std::tan(options.sideways_deg * kPerDegree) * std::abs(d.x) &&
         std::abs(d.z) <= options.sideways_forward * across &&
         std::abs(roll_of(motion.left_from_right)) <= options.sideways_roll_deg * kPerDegree &&
         std::abs(std::log(motion.zoom)) <= options.sideways_zoom;
}

std::optional<PairMotion> find_any_motion(const std::vector<FeatureMatch>& matches, int width, int height,
                                          double tolerance_px, const AnyMotionOptions& options) {
  auto motion = find_pair_motion(matches, width, height, tolerance_px);
  if (!motion) return motion;
  const auto explained = static_cast<double>(motion->inliers.size());
  if (explained < options.least_share * static_cast<double>(matches.size()) ||
      motion->parallax_px < options.least_parallax_px || motion->same_sign < options.least_same_sign)
    return std::nullopt;
  return motion;
}

bool explains_more(const PairMotion& motion, std::size_t on_rows, const AnyMotionOptions& options) {
  return static_cast<double>(motion.inliers.size()) >= options.more_matches * static_cast<double>(on_rows);
}

bool explains_offsets(const PairMotion& motion, const VerticalOffsets& offsets,
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
  const double residual_px = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, corrected)));
  return static_cast<double>(motion.inliers.size()) >=
             options.instead_of_offsets * static_cast<double>(corrected) &&
         motion.residual_px <= options.as_near_as_offsets * residual_px;
}

bool keeps_picture(const Matrix3& homography, int width, int height, const AnyMotionOptions& options) {
  // The roll at the middle, by a step to the right there.
  const PicturePoint middle{0.5 * (width - 1), 0.5 * (height - 1)};
  const PicturePoint from = mapped(homography, middle), to = mapped(homography, {middle.x + 1.0, middle.y});
  if (std::abs(std::atan2(to.y - from.y, to.x - from.x)) > options.most_roll_deg * kPerDegree) return false;
  constexpr int kPlaces = 16;
  int kept = 0;
  for (int j = 0; j < kPlaces; ++j)
    for (int i = 0; i < kPlaces; ++i) {
      const PicturePoint p = mapped(homography, {(i + 0.5) / kPlaces * width, (j + 0.5) / kPlaces * height});
      kept += p.x >= 0.0 && p.y >= 0.0 && p.x < width && p.y < height ? 1 : 0;
    }
  return kept >= options.least_kept * kPlaces * kPlaces;
}

std::optional<AnyMotion> frame_of_motion(const PairMotion& motion, const std::vector<FeatureMatch>& matches,
                                         int width, int height, double tolerance_px, std::uint64_t seed,
                                         const AnyMotionOptions& options) {
  const PicturePoint centre{0.5 * (width - 1), 0.5 * (height - 1)};
  const Vec3& d = motion.direction;
  std::optional<AnyMotion> out;
  if (std::abs(d.z) <= options.polar_forward * std::hypot(d.x, d.y))
    out = turned(motion, matches, centre, tolerance_px, seed);
  else
    out = polar(motion, centre);
  if (!out) return out;
  out->residual_px = rms_off_rows(out->frame, out->inliers);
  out->words = words_of(d);
  return out;
}

}  // namespace palpable::vision
