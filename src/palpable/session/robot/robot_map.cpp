// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/robot_map.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::session {
namespace {

/// Cells of a side, a power of two: the index of a cell is its place modulo this.
constexpr std::int32_t kSide = 128;
/// Farther readings are too noisy, and their floor too sensitive to the camera's tilt.
constexpr double kFarthest_m = 2.5;
/// What rises above the floor by more is an obstacle: at the robot, and more for each metre of distance,
/// since the camera's tilt is known to about a degree.
constexpr double kStep_m = 0.025;
constexpr double kStepPerMetre = 0.015;
/// A blocked cell becomes free after this many pictures of its floor with nothing on it.
constexpr std::uint8_t kClearing = 3;
/// Readings that are used, in each direction.
constexpr int kMostReadings = 120;

std::size_t index_of(std::int32_t x, std::int32_t y) {
  const auto wrapped = [](std::int32_t v) { return static_cast<std::size_t>(v & (kSide - 1)); };
  return wrapped(y) * kSide + wrapped(x);
}

}  // namespace

RobotPose moved_along(const RobotPose& from, double forward_m, double turn_rad) {
  // The chord of the arc.
  const double half_rad = 0.5 * turn_rad;
  const double chord_m = std::abs(half_rad) > 1e-6 ? forward_m * std::sin(half_rad) / half_rad : forward_m;
  const double along_rad = from.heading_rad + half_rad;
  return {from.x_m + chord_m * std::cos(along_rad), from.y_m + chord_m * std::sin(along_rad),
          from.heading_rad + turn_rad};
}

RobotMap::RobotMap(const RobotShape& shape)
    : shape_(shape), entries_(std::size_t{kSide} * kSide), seen_(std::size_t{kSide} * kSide) {}

RobotMap::Place RobotMap::place_of(double x_m, double y_m) {
  return {static_cast<std::int32_t>(std::floor(x_m / kCell_m)),
          static_cast<std::int32_t>(std::floor(y_m / kCell_m))};
}

/// The entry of a cell, which may have been that of another, far away.
RobotMap::Entry& RobotMap::entry(const Place& place) {
  Entry& found = entries_[index_of(place.x, place.y)];
  if (found.x != place.x || found.y != place.y) found = {place.x, place.y, Cell::unknown, 0};
  return found;
}

RobotMap::Cell RobotMap::cell(const Place& place) const {
  const Entry& found = entries_[index_of(place.x, place.y)];
  return found.x == place.x && found.y == place.y ? found.cell : Cell::unknown;
}

void RobotMap::begin(const RobotPose& pose, double free_m) {
  std::fill(entries_.begin(), entries_.end(), Entry{});
  const auto cells = static_cast<std::int32_t>(std::ceil(free_m / kCell_m));
  const Place middle = place_of(pose.x_m, pose.y_m);
  for (std::int32_t dy = -cells; dy <= cells; ++dy)
    for (std::int32_t dx = -cells; dx <= cells; ++dx)
      if (kCell_m * std::hypot(dx, dy) <= free_m) entry({middle.x + dx, middle.y + dy}).cell = Cell::free;
}

void RobotMap::take(const Place& place, const Seen& seen) {
  Entry& known = entry(place);
  if (seen.obstacle) {
    known.cell = Cell::blocked;
    known.cleared = 0;
  } else if (known.cell != Cell::blocked || ++known.cleared >= kClearing) {
    known.cell = Cell::free;
    known.cleared = 0;
  }
}

void RobotMap::add(const DepthMap& depth, const RobotPose& pose) {
  PALPABLE_CHECK(depth.camera.has_value());
  const Pinhole& camera = *depth.camera;
  const double down_sin = std::sin(shape_.camera_down_rad), down_cos = std::cos(shape_.camera_down_rad);
  const double heading_sin = std::sin(pose.heading_rad), heading_cos = std::cos(pose.heading_rad);
  // What the robot's top would meet must be in the picture as well, or the floor below it is not free.
  const double up = std::tan(std::atan2(camera.cy, camera.fy) - shape_.camera_down_rad);
  const auto shows_the_top = [&](double ahead_m) {
    return shape_.camera_height_m + ahead_m * up >= shape_.height_m;
  };
  std::fill(seen_.begin(), seen_.end(), Seen{});
  const int step = std::max(1, std::max(depth.depth_m.width(), depth.depth_m.height()) / kMostReadings);
  std::vector<Place> places;
  for (int v = step / 2; v < depth.depth_m.height(); v += step)
    for (int u = step / 2; u < depth.depth_m.width(); u += step) {
      const double z = double{depth.depth_m(u, v)};
      if (!(z > 0.0) || z > 2.0 * kFarthest_m) continue;
      const double right_m = z * (u - camera.cx) / camera.fx - shape_.camera_left_m;
      const double below_m = z * (v - camera.cy) / camera.fy;
      const double ahead_m = z * down_cos - below_m * down_sin;
      const double height_m = shape_.camera_height_m - z * down_sin - below_m * down_cos;
      if (ahead_m > kFarthest_m || height_m > shape_.height_m) continue;
      const bool is_floor = height_m < kStep_m + kStepPerMetre * ahead_m;
      if (is_floor && !shows_the_top(ahead_m)) continue;
      const double forward_m = ahead_m + shape_.camera_forward_m;
      const Place place = place_of(pose.x_m + forward_m * heading_cos + right_m * heading_sin,
                                   pose.y_m + forward_m * heading_sin - right_m * heading_cos);
      Seen& seen = seen_[index_of(place.x, place.y)];
      if (!seen.floor && !seen.obstacle) places.push_back(place);
      (is_floor ? seen.floor : seen.obstacle) = true;
    }
  for (const Place& place : places) take(place, seen_[index_of(place.x, place.y)]);
}

double RobotMap::nearest_floor_m(const Pinhole& camera) const {
  constexpr double kStraightDown_rad = 1.5;
  const double lowest_rad = shape_.camera_down_rad + std::atan2(camera.height - 1 - camera.cy, camera.fy);
  const double ahead_m = lowest_rad > 0.0
                             ? shape_.camera_height_m / std::tan(std::min(lowest_rad, kStraightDown_rad))
                             : kFarthest_m;
  // A cell is seen when a reading falls into it.
  return shape_.camera_forward_m + std::min(ahead_m, kFarthest_m) + 2.0 * kCell_m;
}

double RobotMap::free_distance_m(const RobotPose& pose, double turn_per_m, double margin_m,
                                 double longest_m) const {
  const double reach_m = shape_.radius_m + margin_m;
  const auto cells = static_cast<std::int32_t>(std::ceil(reach_m / kCell_m)) + 1;
  const auto meets = [&](const RobotPose& at) {
    const Place middle = place_of(at.x_m, at.y_m);
    for (std::int32_t dy = -cells; dy <= cells; ++dy)
      for (std::int32_t dx = -cells; dx <= cells; ++dx) {
        const Place place{middle.x + dx, middle.y + dy};
        if (cell(place) == Cell::free) continue;
        const double x_m = kCell_m * (place.x + 0.5), y_m = kCell_m * (place.y + 0.5);
        const double here_m = std::hypot(x_m - at.x_m, y_m - at.y_m);
        const double before_m = std::hypot(x_m - pose.x_m, y_m - pose.y_m);
        if (here_m < reach_m && here_m < before_m) return true;
      }
    return false;
  };
  for (double way_m = kCell_m / 2; way_m < longest_m; way_m += kCell_m / 2)
    if (meets(moved_along(pose, way_m, way_m * turn_per_m))) return way_m - kCell_m / 2;
  return longest_m;
}

RobotFloor RobotMap::floor(const RobotPose& pose) const {
  constexpr int kShown = 48;
  RobotFloor floor{pose, shape_, Raster<Cell>(kShown, kShown), 0.0, Cell::free, {}, {}};
  const double sine = std::sin(pose.heading_rad), cosine = std::cos(pose.heading_rad);
  const auto at = [&](double ahead_m, double left_m) {
    return cell(
        place_of(pose.x_m + ahead_m * cosine - left_m * sine, pose.y_m + ahead_m * sine + left_m * cosine));
  };
  const auto note_side = [&](double ahead_m, double left_m) {
    const double away_m = std::max(0.0, std::hypot(ahead_m, left_m) - shape_.radius_m);
    auto& side_m = left_m > 0.0 ? floor.left_m : floor.right_m;
    if (std::abs(left_m) >= std::abs(ahead_m)) side_m = std::min(side_m.value_or(away_m), away_m);
  };
  for (int row = 0; row < kShown; ++row)
    for (int column = 0; column < kShown; ++column) {
      const double ahead_m = kCell_m * (0.5 * (kShown - 1) - row);
      const double left_m = kCell_m * (0.5 * (kShown - 1) - column);
      const Cell known = at(ahead_m, left_m);
      floor.cells(column, row) = known;
      if (known == Cell::blocked) note_side(ahead_m, left_m);
    }
  floor.ahead_m = free_distance_m(pose, 0.0, 0.0, kFloorSeen_m);
  if (floor.ahead_m < kFloorSeen_m) {
    floor.ahead_ends = Cell::unknown;
    // Half of its outline, a cell farther on.
    const double reach_m = shape_.radius_m + kCell_m;
    for (double ahead_m = 0.0; ahead_m < reach_m; ahead_m += 0.5 * kCell_m)
      for (double left_m = -reach_m; left_m < reach_m; left_m += 0.5 * kCell_m)
        if (std::hypot(ahead_m, left_m) < reach_m && at(floor.ahead_m + ahead_m, left_m) == Cell::blocked)
          floor.ahead_ends = Cell::blocked;
  }
  return floor;
}

}  // namespace palpable::session
