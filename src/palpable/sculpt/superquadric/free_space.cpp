// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/free_space.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/models/field/superquadric_mesh.hpp"
#include "palpable/sculpt/superquadric/point_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace palpable::sculpt {
namespace {

std::array<Vec3, 3> axes_along(Vec3 ahead) {
  const Vec3 helper = std::abs(ahead.y) < 0.9 ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0};
  const Vec3 right = unit(cross(ahead, helper));
  return {right, cross(ahead, right), ahead};
}

std::vector<Vec3> directions_around() {
  std::vector<Vec3> directions;
  for (const double x : {-1.0, 1.0}) {
    for (const Vec3 axis : {Vec3{x, 0.0, 0.0}, Vec3{0.0, x, 0.0}, Vec3{0.0, 0.0, x}})
      directions.push_back(axis);
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) directions.push_back(unit(Vec3{x, y, z}));
  }
  return directions;
}

/// The distance that most points keep from their fourth nearest neighbour, metres: in pictures of a solid
/// from all sides, no pixels are finer, or its silhouette would fall apart.
double spacing_of(std::span<const Vec3> points_m) {
  constexpr std::size_t kSampled = 200, kNeighbour = 4;
  std::vector<double> spacings;
  std::vector<double> squares(points_m.size());
  for (std::size_t k = 0; k < kSampled; ++k) {
    const Vec3 from = points_m[k * points_m.size() / kSampled];
    std::transform(points_m.begin(), points_m.end(), squares.begin(),
                   [from](Vec3 p) { return squared_norm(p - from); });
    const auto at = squares.begin() + static_cast<std::ptrdiff_t>(std::min(kNeighbour, squares.size() - 1));
    std::nth_element(squares.begin(), at, squares.end());
    spacings.push_back(std::sqrt(*at));
  }
  return quantile_of(spacings, 0.9);
}

cv::Mat viewed(Raster<float>& raster) { return {raster.height(), raster.width(), CV_32F, raster.data()}; }

/// Fills gaps up to twice `closed_px` wide with the least depth around, and measures how far each pixel is
/// from what is then known. Unknown depths are infinite before.
void close(Raster<float>& depth_m, Raster<float>& outside_px, int closed_px) {
  const cv::Mat window = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * closed_px + 1, 2 * closed_px + 1});
  cv::Mat depths = viewed(depth_m), outside = viewed(outside_px), least;
  cv::erode(depths, least, window, {-1, -1}, 1, cv::BORDER_CONSTANT,
            cv::Scalar::all(std::numeric_limits<double>::infinity()));
  const cv::Mat grown = least < std::numeric_limits<float>::max();
  cv::Mat closed;
  cv::erode(grown, closed, window, {-1, -1}, 1, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  least.setTo(std::numeric_limits<float>::quiet_NaN(), closed == 0);
  least.copyTo(depths);
  cv::distanceTransform(closed == 0, outside, cv::DIST_L2, cv::DIST_MASK_5);
}

}  // namespace

std::vector<Parameter> parameters_of(FreeSpaceOptions& o) {
  return {{"most_pixels", &o.most_pixels, {16, 4096}, "px", "longer side of a picture of the points"},
          {"closed_px", &o.closed_px, {1, 16}, "px", "gaps that are closed, and tolerance at silhouettes"},
          {"drawn_points", &o.drawn_points, {12, 1e7}, "", "most points that are drawn"}};
}

FreeSpace::Picture::Place FreeSpace::Picture::place_of(Vec3 p) const {
  const Vec3 d = p - origin_m;
  const double ahead_m = dot(d, axes[2]);
  const double scale = central ? 1.0 / (pixel * ahead_m) : 1.0 / pixel;
  return {dot(d, axes[0]) * scale - left, dot(d, axes[1]) * scale - top, ahead_m};
}

FreeSpace::Picture FreeSpace::picture_of(std::span<const Vec3> points_m, Picture frame, double least_pixel_m,
                                         const FreeSpaceOptions& options) {
  frame.pixel = 1.0;
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  double left = kInfinite, top = kInfinite, right = -kInfinite, bottom = -kInfinite;
  std::vector<Picture::Place> places;
  for (const Vec3 p : points_m) {
    const auto at = frame.place_of(p);
    if (frame.central && !(at.depth_m > 0.0)) continue;
    places.push_back(at);
    left = std::min(left, at.u), right = std::max(right, at.u);
    top = std::min(top, at.v), bottom = std::max(bottom, at.v);
  }
  // About one point a pixel, if a silhouette fills half of its box and shows half of a solid's points.
  const double seen =
      (frame.central ? 1.0 : 0.5) * static_cast<double>(std::max<std::size_t>(1, places.size()));
  const double longer = std::max({right - left, bottom - top, 1e-12});
  frame.pixel = std::max(
      {std::sqrt(0.5 * (right - left) * (bottom - top) / seen), longer / options.most_pixels, least_pixel_m});
  const int rim = options.closed_px + 1;
  frame.left = left / frame.pixel - rim, frame.top = top / frame.pixel - rim;
  const int width = static_cast<int>((right - left) / frame.pixel) + 2 * rim + 2,
            height = static_cast<int>((bottom - top) / frame.pixel) + 2 * rim + 2;
  frame.depth_m = Raster<float>(width, height, std::numeric_limits<float>::infinity());
  frame.outside_px = Raster<float>(width, height, 0.0F);
  for (const Picture::Place& at : places) {
    float& depth_m = frame.depth_m(static_cast<int>(std::lround(at.u / frame.pixel - frame.left)),
                                   static_cast<int>(std::lround(at.v / frame.pixel - frame.top)));
    depth_m = std::min(depth_m, static_cast<float>(at.depth_m));
  }
  close(frame.depth_m, frame.outside_px, options.closed_px);
  return frame;
}

FreeSpace::FreeSpace(std::span<const Vec3> all_m, const std::optional<Point<SceneFrame>>& eye, double slack_m,
                     const FreeSpaceOptions& options)
    : slack_m_(slack_m), closed_px_(options.closed_px) {
  std::vector<Vec3> points_m;
  for (const std::uint32_t i : thinned(all_m, static_cast<std::size_t>(options.drawn_points)))
    points_m.push_back(all_m[i]);
  if (!eye) {
    const double least_pixel_m = 0.5 * spacing_of(points_m);
    for (const Vec3 ahead : directions_around())
      pictures_.push_back(
          picture_of(points_m, {{}, axes_along(ahead), false, 0, 0, 0, {}, {}}, least_pixel_m, options));
    return;
  }
  Vec3 ahead;
  for (const Vec3 p : points_m) ahead += unit(p - eye->v);
  pictures_.push_back(
      picture_of(points_m, {eye->v, axes_along(unit(ahead)), true, 0, 0, 0, {}, {}}, 0.0, options));
}

FreeSpace::Depths FreeSpace::depths_in(const Picture& picture, Vec3 p) const {
  const auto at = picture.place_of(p);
  // Nobody looked behind the eye.
  if (picture.central && !(at.depth_m > 0.0)) return {};
  const int width = picture.depth_m.width(), height = picture.depth_m.height();
  const double x = std::clamp(at.u, 0.0, width - 1.0), y = std::clamp(at.v, 0.0, height - 1.0);
  const auto u = static_cast<int>(x + 0.5), v = static_cast<int>(y + 0.5);
  const double beside_px = std::max(std::abs(at.u - x), std::abs(at.v - y));
  const double outside_px = beside_px + static_cast<double>(picture.outside_px(u, v));
  if (outside_px > 0.0) {
    const double pixel_m = picture.central ? picture.pixel * at.depth_m : picture.pixel;
    return {std::max(0.0, (outside_px - closed_px_) * pixel_m), 0.0};
  }
  return {0.0, std::max(0.0, static_cast<double>(picture.depth_m(u, v)) - at.depth_m - slack_m_)};
}

double FreeSpace::depth_m(Vec3 p) const {
  double outside_m = 0.0;
  std::array<double, kWitnesses> in_front_m{};  // the greatest ones, descending
  for (const Picture& picture : pictures_) {
    const Depths depths = depths_in(picture, p);
    outside_m = std::max(outside_m, depths.outside_m);
    double deeper_m = depths.in_front_m;
    for (double& kept_m : in_front_m)
      if (deeper_m > kept_m) std::swap(deeper_m, kept_m);
  }
  return std::max(outside_m, pictures_.size() > 1 ? in_front_m.back() : in_front_m.front());
}

std::vector<Vec3> FreeSpace::places_around(std::span<const Vec3> points_m, double reach_m, std::size_t most,
                                           std::uint64_t seed) const {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> even(0.0, 1.0);
  std::vector<Vec3> places;
  constexpr std::size_t kTries = 6;
  for (std::size_t k = 0; k < kTries * most && places.size() < most; ++k) {
    const Vec3 from = points_m[random() % points_m.size()];
    const Vec3 direction = unit(Vec3{normal(random), normal(random), normal(random)});
    const double share = even(random);
    const Vec3 p = from + share * share * reach_m * direction;
    if (depth_m(p) > 0.0) places.push_back(p);
  }
  return places;
}

SurfaceBeyond surface_beyond(const FreeSpace& space, const models::Superquadric& shape) {
  constexpr double kSpacing = 0.35;
  const Vec3 half_m = shape.size_m;
  const Mesh mesh = models::mesh_of(shape, kSpacing * std::max({half_m.x, half_m.y, half_m.z}));
  SurfaceBeyond beyond;
  double area_m2 = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]], b = mesh.vertices_m[t[1]], c = mesh.vertices_m[t[2]];
    const double part_m2 = norm(cross(b - a, c - a));
    const double depth_m = space.depth_m((a + b + c) / 3.0);
    area_m2 += part_m2;
    if (depth_m > space.slack_m()) beyond.share += part_m2, beyond.mean_m += depth_m * part_m2;
  }
  return {beyond.share / area_m2, beyond.mean_m / area_m2};
}

std::optional<models::Superquadric> trimmed(const FreeSpace& space, models::Superquadric shape,
                                            double share) {
  constexpr double kStep = 0.05;
  const Vec3 least_m = shape.size_m / 3.0;
  SurfaceBeyond beyond = surface_beyond(space, shape);
  constexpr double kHopeless = 0.3;
  if (beyond.share > std::max(kHopeless, share)) return std::nullopt;
  while (beyond.share > share) {
    std::optional<models::Superquadric> best;
    SurfaceBeyond of_best{1.0, std::numeric_limits<double>::infinity()};
    for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z})
      for (const double end : {-1.0, 0.0, 1.0}) {
        models::Superquadric other = shape;
        const double moved_m = kStep * shape.size_m.*axis;
        other.size_m.*axis -= end == 0.0 ? 2.0 * moved_m : moved_m;
        Vec3 shift;
        shift.*axis = -end * moved_m;
        other.scene_from_shape.translation_m += shape.scene_from_shape.rotate(shift);
        const SurfaceBeyond of_other = surface_beyond(space, other);
        if (other.size_m.*axis < least_m.*axis || of_other.mean_m >= of_best.mean_m) continue;
        best = other, of_best = of_other;
      }
    if (!best) return std::nullopt;
    shape = *best, beyond = of_best;
  }
  return shape;
}

}  // namespace palpable::sculpt
