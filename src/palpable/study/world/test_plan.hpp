// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Ways through a room for simulated persons who know its plan.

#include "palpable/core/picture/raster.hpp"
#include "palpable/study/world/robot_world.hpp"
#include "palpable/study/world/room.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace palpable::study {

struct Place {
  double x_m = 0.0, y_m = 0.0;
};

inline bool stands_on_floor(const Furniture& furniture) {
  return std::any_of(furniture.solids.begin(), furniture.solids.end(),
                     [](const Solid& s) { return s.centre_m.z - s.half_m.z <= 0.0; });
}

/// Cells of 5 cm, on which a way leads to a place from which the robot's camera sees an object.
class RoomPlan {
 public:
  RoomPlan(const Room& room, const RobotBody& body, int object)
      : cost_(cells(room.size_m.x), cells(room.size_m.y), 0.0F), ends_(cost_.width(), cost_.height(), 0) {
    object_alone_.size_m = {100.0, 100.0, room.size_m.z};
    const Furniture& furniture = room.furniture[static_cast<std::size_t>(object)];
    object_alone_.furniture.push_back(furniture);
    object_place_ = {centre_of(furniture).v.x, centre_of(furniture).v.y};
    for (int j = 0; j < cost_.height(); ++j)
      for (int i = 0; i < cost_.width(); ++i) {
        cost_(i, j) = cost_at(room, body, place_of(i, j));
        ends_(i, j) = cost_(i, j) < kClosed && sees(room, body, place_of(i, j), object) ? 1 : 0;
      }
    open_ = cost_;
  }

  /// Empty: there is none.
  std::vector<Place> way_from(const FloorPose& pose) const {
    using Open = std::pair<float, int>;
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
    std::vector<float> best(cost_.count(), std::numeric_limits<float>::infinity());
    std::vector<int> before(cost_.count(), -1);
    const int first = index_at(pose);
    best[static_cast<std::size_t>(first)] = 0.0F;
    open.emplace(0.0F, first);
    while (!open.empty()) {
      const auto [cost, cell] = open.top();
      open.pop();
      const auto here = static_cast<std::size_t>(cell);
      if (cost > best[here]) continue;
      if (ends_.values()[here] != 0) return way_to(cell, before);
      const int i = cell % cost_.width(), j = cell / cost_.width();
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) {
          const int x = i + di, y = j + dj;
          if (x < 0 || y < 0 || x >= cost_.width() || y >= cost_.height() || cost_(x, y) >= kClosed) continue;
          const auto there = static_cast<std::size_t>(y * cost_.width() + x);
          const float sum = cost + static_cast<float>(std::hypot(di, dj)) * cost_(x, y);
          if (!(sum < best[there])) continue;
          best[there] = sum;
          before[there] = cell;
          open.emplace(sum, static_cast<int>(there));
        }
    }
    return {};
  }
  /// The robot went no farther here: what is ahead is no way.
  void close(const FloorPose& pose) {
    constexpr double kAhead_m = 0.3, kAround_m = 0.2;
    const double x_m = pose.x_m + kAhead_m * std::cos(pose.heading_rad);
    const double y_m = pose.y_m + kAhead_m * std::sin(pose.heading_rad);
    for (int j = 0; j < cost_.height(); ++j)
      for (int i = 0; i < cost_.width(); ++i)
        if (std::hypot(place_of(i, j).x_m - x_m, place_of(i, j).y_m - y_m) < kAround_m) {
          cost_(i, j) = kClosed;
          ends_(i, j) = 0;
        }
  }
  void reopen() { cost_ = open_; }

  const Place& object_place() const { return object_place_; }
  /// The object in a room of its own.
  const Room& object_alone() const { return object_alone_; }

 private:
  static constexpr double kCell_m = 0.05;
  static constexpr float kClosed = 1e6F;

  static int cells(double size_m) { return static_cast<int>(size_m / kCell_m); }
  Place place_of(int i, int j) const {
    return {kCell_m * (i - 0.5 * (cost_.width() - 1)), kCell_m * (j - 0.5 * (cost_.height() - 1))};
  }
  int index_at(const FloorPose& pose) const {
    const auto near = [](double at_m, int count) {
      return std::clamp(static_cast<int>(std::lround(at_m / kCell_m + 0.5 * (count - 1))), 0, count - 1);
    };
    return near(pose.y_m, cost_.height()) * cost_.width() + near(pose.x_m, cost_.width());
  }
  /// Of a way of one cell: more beside furniture, which the robot keeps from.
  static float cost_at(const Room& room, const RobotBody& body, const Place& place) {
    constexpr std::array<std::pair<double, float>, 3> kCosts{{{0.12, kClosed}, {0.2, 12.0F}, {0.3, 3.0F}}};
    for (const auto& [around_m, cost] : kCosts)
      if (touches(room, {place.x_m, place.y_m, body.radius_m + around_m, body.height_m})) return cost;
    return 1.0F;
  }
  /// Whether the object is before a camera that looks at its middle from here, at arm's length or two.
  bool sees(const Room& room, const RobotBody& body, const Place& place, int object) const {
    constexpr double kNear_m = 0.3, kFar_m = 1.0;
    const double heading_rad = std::atan2(object_place_.y_m - place.y_m, object_place_.x_m - place.x_m);
    const Vec3 eye{place.x_m + body.camera_forward_m * std::cos(heading_rad),
                   place.y_m + body.camera_forward_m * std::sin(heading_rad), body.camera_height_m};
    const double top = top_m(object_alone_.furniture.front());
    for (const double height_m : {0.15, 0.35, 0.55, top - 0.02}) {
      if (height_m >= top) continue;
      const Vec3 way = Vec3{object_place_.x_m, object_place_.y_m, height_m} - eye;
      const Hit hit = cast_ray(room, {eye}, {way / norm(way)});
      if (hit.object == object && hit.along > kNear_m && hit.along < kFar_m) return true;
    }
    return false;
  }
  std::vector<Place> way_to(int cell, const std::vector<int>& before) const {
    std::vector<Place> way;
    for (; cell >= 0; cell = before[static_cast<std::size_t>(cell)])
      way.push_back(place_of(cell % cost_.width(), cell / cost_.width()));
    std::reverse(way.begin(), way.end());
    return way;
  }

  Raster<float> cost_, open_;
  Raster<std::uint8_t> ends_;
  Room object_alone_;
  Place object_place_;
};

}  // namespace palpable::study
