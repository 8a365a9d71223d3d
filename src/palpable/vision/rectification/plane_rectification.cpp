// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/plane_rectification.hpp"

#include "palpable/vision/image/opencv_image.hpp"
#include "palpable/vision/rectification/half_diagonals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

using Line = cv::Vec3d;
using HomogeneousPoint = cv::Vec3d;
/// A direction in the affine picture, which equals the plane up to a linear map.
using Direction = cv::Vec2d;

HomogeneousPoint place_of(const PicturePoint& p, const cv::Matx33d& n) {
  return n * HomogeneousPoint(p.x, p.y, 1.0);
}

Line line_of(const PictureLine& line, const cv::Matx33d& n) {
  const Line through = place_of(line.from, n).cross(place_of(line.to, n));
  return through / std::hypot(through[0], through[1]);
}

HomogeneousPoint meeting(const Line& a, const Line& b) {
  const HomogeneousPoint p = a.cross(b);
  const double length = cv::norm(p);
  return length > 0.0 ? p / length : p;
}

/// The projective geometry of the plane: its vanishing line, and directions at right angles.
struct Geometry {
  Line vanishing;
  std::vector<std::array<HomogeneousPoint, 2>> orthogonal;
  HomogeneousPoint along;
};

/// H1 of the paper: maps the vanishing line to infinity.
cv::Matx33d affine_from_picture(const Line& vanishing) {
  const Line l = vanishing * (vanishing[2] < 0.0 ? -1.0 : 1.0);
  return {1, 0, 0, 0, 1, 0, l[0] / l[2], l[1] / l[2], 1};
}

Direction direction_of(const HomogeneousPoint& vanishing_point, const cv::Matx33d& affine) {
  const HomogeneousPoint p = affine * vanishing_point;
  const double length = std::hypot(p[0], p[1]);
  return {p[0] / length, p[1] / length};
}

/// S = A Aᵀ with x_affine = A x_plane, from l' S m = 0 for the normals of each orthogonal pair of directions.
std::optional<cv::Matx22d> circular_points_conic(const std::vector<std::array<Direction, 2>>& orthogonal) {
  cv::Mat rows(0, 3, CV_64F);
  for (const auto& [d, e] : orthogonal) {
    const Direction l(-d[1], d[0]), m(-e[1], e[0]);
    const cv::Matx13d row(l[0] * m[0], l[0] * m[1] + l[1] * m[0], l[1] * m[1]);
    rows.push_back(cv::Mat(row));
  }
  cv::Mat w, u, vt;
  cv::SVD::compute(rows, w, u, vt, cv::SVD::FULL_UV);
  constexpr double kIndependent = 1e-3;
  if (w.total() < 2 || w.at<double>(1) < kIndependent * w.at<double>(0)) return std::nullopt;
  const double* s = vt.ptr<double>(2);
  const double sign = s[0] + s[2] < 0.0 ? -1.0 : 1.0;
  const cv::Matx22d conic(sign * s[0], sign * s[1], sign * s[1], sign * s[2]);
  if (!(conic(0, 0) > 0.0) || !(cv::determinant(conic) > 1e-6 * conic(0, 0) * conic(1, 1)))
    return std::nullopt;
  return conic;
}

/// H2⁻¹: the lower Cholesky factor A of S; its inverse maps the affine picture to the plane.
cv::Matx33d plane_from_affine(const cv::Matx22d& s) {
  const double a = std::sqrt(s(0, 0)), b = s(0, 1) / a, c = std::sqrt(s(1, 1) - b * b);
  const cv::Matx33d forward(a, 0, 0, b, c, 0, 0, 0, 1);
  return forward.inv();
}

/// The focal length (in half diagonals) that makes the directions of two vanishing points orthogonal, with
/// the principal point in the middle; nullopt if it is undetermined or implausible.
std::optional<double> focal_of(const HomogeneousPoint& v1, const HomogeneousPoint& v2,
                               const PlaneRectificationOptions& options) {
  const double shortest = options.shortest_focal, longest = options.longest_focal;
  if (std::abs(v1[2]) < 0.02 || std::abs(v2[2]) < 0.02) return std::nullopt;
  const double squared = -(v1[0] * v2[0] + v1[1] * v2[1]) / (v1[2] * v2[2]);
  if (!(squared > shortest * shortest && squared < longest * longest)) return std::nullopt;
  return std::sqrt(squared);
}

/// Two independent orthogonal pairs of directions of the plane with vanishing line `vanishing`, for a camera
/// of this focal length: the plane's axes, and these rotated by 45 degrees.
std::vector<std::array<HomogeneousPoint, 2>> pairs_by_camera(const Line& vanishing, double focal) {
  const cv::Matx33d camera(focal, 0, 0, 0, focal, 0, 0, 0, 1);
  const cv::Vec3d normal = cv::normalize(cv::Vec3d(camera.t() * vanishing));
  const cv::Vec3d off = std::abs(normal[0]) < 0.7 ? cv::Vec3d(1, 0, 0) : cv::Vec3d(0, 1, 0);
  const cv::Vec3d d = cv::normalize(normal.cross(off)), e = normal.cross(d);
  return {{camera * d, camera * e}, {camera * (d + e), camera * (d - e)}};
}

double usual_focal(const Image& picture) {
  return usual_camera(picture.width, picture.height).matrix[0] * 2.0 /
         std::hypot(picture.width, picture.height);
}

/// Adds orthogonal pairs from the camera model if there are too few.
void complete(Geometry& geometry, const HomogeneousPoint& across, const Image& picture,
              const PlaneRectificationOptions& options, std::vector<Note>& notes) {
  if (geometry.orthogonal.size() >= 2) return;
  const auto focal = focal_of(geometry.along, across, options);
  if (!focal)
    notes.emplace_back(
        "The lines do not determine the camera's focal length; 65 degrees across the picture were assumed "
        "for "
        "the proportions.");
  geometry.orthogonal = pairs_by_camera(geometry.vanishing, focal.value_or(usual_focal(picture)));
}

/// The plane from the normalised picture, with `along` horizontal and to the right, not mirrored.
std::optional<cv::Matx33d> plane_from(const Geometry& geometry) {
  if (std::abs(geometry.vanishing[2]) < 1e-3) return std::nullopt;
  const cv::Matx33d affine = affine_from_picture(geometry.vanishing);
  std::vector<std::array<Direction, 2>> orthogonal;
  for (const auto& [a, b] : geometry.orthogonal)
    orthogonal.push_back({direction_of(a, affine), direction_of(b, affine)});
  const auto conic = circular_points_conic(orthogonal);
  if (!conic) return std::nullopt;
  const cv::Matx33d plane = plane_from_affine(*conic) * affine;
  Direction level = direction_of(geometry.along, plane);
  // The direction nearest to the picture's right becomes the right.
  if (level[0] < 0.0) level = -level;
  if (std::abs(level[1]) > std::abs(level[0]))
    level = level[1] < 0.0 ? Direction(-level[1], level[0]) : Direction(level[1], -level[0]);
  const cv::Matx33d turn(level[0], level[1], 0, -level[1], level[0], 0, 0, 0, 1);
  return turn * plane;
}

cv::Point2d mapped(const cv::Matx33d& h, double x, double y) {
  const cv::Vec3d p = h * cv::Vec3d(x, y, 1.0);
  return {p[0] / p[2], p[1] / p[2]};
}

struct Box {
  double left = std::numeric_limits<double>::infinity();
  double top = left, right = -left, bottom = -left;
  void take(cv::Point2d p) {
    left = std::min(left, p.x);
    right = std::max(right, p.x);
    top = std::min(top, p.y);
    bottom = std::max(bottom, p.y);
  }
};

/// The bounding box of the picture's mapped pixels, without those near the horizon, which would dominate it.
Box box_of(const cv::Matx33d& h, const Image& picture, double least_nearness) {
  constexpr int kSteps = 64;
  Box box;
  const double middle = (h * cv::Vec3d(0.5 * picture.width, 0.5 * picture.height, 1.0))[2];
  for (int j = 0; j <= kSteps; ++j)
    for (int i = 0; i <= kSteps; ++i) {
      const double x = (picture.width - 1.0) * i / kSteps, y = (picture.height - 1.0) * j / kSteps;
      if ((h * cv::Vec3d(x, y, 1.0))[2] / middle > least_nearness) box.take(mapped(h, x, y));
    }
  return box;
}

/// Renders the rectified plane, within limits at the input's highest resolution.
RectifiedPlane drawn(const Image& picture, const cv::Matx33d& plane_from_pixel, const Box& box,
                     const PlaneRectificationOptions& options) {
  const double longer = std::max(picture.width, picture.height);
  const double extent = std::max(box.right - box.left, box.bottom - box.top);
  const double scale = std::min(options.enlargement * longer, options.most_side_px) / extent;
  const cv::Matx33d place(scale, 0, -scale * box.left, 0, scale, -scale * box.top, 0, 0, 1);
  const cv::Matx33d whole = place * plane_from_pixel;
  const cv::Size size(std::max(1, static_cast<int>(std::lround(scale * (box.right - box.left))) + 1),
                      std::max(1, static_cast<int>(std::lround(scale * (box.bottom - box.top))) + 1));
  cv::Mat out;
  cv::warpPerspective(view_of(picture), out, whole, size, cv::INTER_LINEAR, cv::BORDER_CONSTANT,
                      cv::Scalar::all(1.0));
  RectifiedPlane result;
  result.picture = image_from(out, picture);
  std::copy_n(whole.val, 9, result.picture_from_input.begin());
  return result;
}

Error no_plane() {
  return invalid_input(
      "these lines determine no plane: two pairs of parallels in different directions are needed, and right "
      "angles that are independent");
}

Error failure(const cv::Exception& e) {
  return {ErrorCode::failed, std::string("the plane could not be rectified: ") + e.what(), {}};
}

}  // namespace

std::vector<Parameter> parameters_of(PlaneRectificationOptions& o) {
  return {{"enlargement", &o.enlargement, {0.1, 8}, "", "longer side over the input's"},
          {"most_side_px", &o.most_side_px, {64, 32768}, "px", "longest side"},
          {"least_nearness", &o.least_nearness, {0.01, 1}, "", "nearness of the farthest part that is kept"},
          {"shortest_focal", &o.shortest_focal, {0.1, 100}, "half diagonals", "shortest focal length"},
          {"longest_focal", &o.longest_focal, {0.1, 100}, "half diagonals", "longest focal length"}};
}

Result<RectifiedPlane> rectify_plane(const Image& picture, const PlaneLines& lines,
                                     const PlaneRectificationOptions& options) {
  if (auto in_range = check_ranges(options); !in_range) return in_range.error();
  try {
    const cv::Matx33d n = half_diagonals_from_pixels(picture);
    const HomogeneousPoint along = meeting(line_of(lines.along[0], n), line_of(lines.along[1], n)),
                           across = meeting(line_of(lines.across[0], n), line_of(lines.across[1], n));
    Geometry geometry{along.cross(across), {}, along};
    const double length = cv::norm(geometry.vanishing);
    if (!(length > 1e-6)) return no_plane();
    geometry.vanishing /= length;
    for (const auto& [a, b] : lines.orthogonal)
      geometry.orthogonal.push_back(
          {meeting(line_of(a, n), geometry.vanishing), meeting(line_of(b, n), geometry.vanishing)});
    std::vector<Note> notes;
    complete(geometry, across, picture, options, notes);
    const auto plane = plane_from(geometry);
    if (!plane) return no_plane();
    const cv::Matx33d from_pixel = *plane * n;
    RectifiedPlane out =
        drawn(picture, from_pixel, box_of(from_pixel, picture, options.least_nearness), options);
    out.notes = std::move(notes);
    return out;
  } catch (const cv::Exception& e) {
    return failure(e);
  }
}

Result<RectifiedPlane> rectify_rectangle(const Image& picture, const PlaneRectangle& rectangle,
                                         const PlaneRectificationOptions& options) {
  if (auto in_range = check_ranges(options); !in_range) return in_range.error();
  try {
    const auto& c = rectangle.corners;
    const cv::Matx33d n = half_diagonals_from_pixels(picture);
    std::vector<cv::Point2f> from, to{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (const PicturePoint& p : c) from.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y));
    if (!cv::isContourConvex(from) || cv::contourArea(from) < 16.0)
      return invalid_input(
          "the four corners are not those of a rectangle, from the upper left one clockwise");
    std::vector<Note> notes;
    double aspect = rectangle.aspect.value_or(0.0);
    const HomogeneousPoint along = meeting(line_of({c[0], c[1]}, n), line_of({c[3], c[2]}, n)),
                           across = meeting(line_of({c[0], c[3]}, n), line_of({c[1], c[2]}, n));
    if (!rectangle.aspect) {
      Geometry geometry{cv::normalize(cv::Vec3d(along.cross(across))), {}, along};
      complete(geometry, across, picture, options, notes);
      const auto plane = plane_from(geometry);
      if (!plane) return no_plane();
      const auto at = [&](const PicturePoint& p) { return mapped(*plane * n, p.x, p.y); };
      aspect = cv::norm(at(c[1]) - at(c[0])) / cv::norm(at(c[3]) - at(c[0]));
    }
    cv::Matx33d unit = cv::Mat(cv::getPerspectiveTransform(from, to));
    const cv::Matx33d wide(aspect, 0, 0, 0, 1, 0, 0, 0, 1);
    Box box;
    box.take({0, 0});
    box.take({aspect, 1.0});
    RectifiedPlane out = drawn(picture, wide * unit, box, options);
    out.notes = std::move(notes);
    return out;
  } catch (const cv::Exception& e) {
    return failure(e);
  }
}

Result<RectifiedPlane> rectify_tilt(const Image& picture, const PlaneTilt& tilt,
                                    const PlaneRectificationOptions& options) {
  if (auto in_range = check_ranges(options); !in_range) return in_range.error();
  try {
    const cv::Matx33d from_pixel(tilt.plane_from_pixel.data());
    return drawn(picture, from_pixel, box_of(from_pixel, picture, options.least_nearness), options);
  } catch (const cv::Exception& e) {
    return failure(e);
  }
}

}  // namespace palpable::vision
