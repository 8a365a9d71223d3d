// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// A simulated person who drives a robot to a piece of furniture and touches it, in simulated time.

#include "palpable/study/world/test_plan.hpp"
#include "palpable/study/world/test_telepresence.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace palpable::study {

/// What became of one visit.
struct Visit {
  std::string object;
  /// The robot stood before it; the hand then lay on it in the live view; the robot touched something.
  bool has_arrived = false, has_touched = false, robot_touched = false;
  double time_s = 0.0, way_m = 0.0;
  /// From the place that the hand touched to the object, m; infinite if it touched none.
  double away_m = std::numeric_limits<double>::infinity();
  /// How far the robot was from where the person believed it.
  double lost_m = 0.0;
  /// How often the person chose another way, since the robot went no farther.
  int detours = 0;
};

/// Knows the plan of the room and where the robot stood first, and then its odometry only. Drives by the
/// hand, beyond its dead zone, as a person does.
class Person {
 public:
  Person(Telepresence& touch, int object)
      : touch_(touch), plan_(touch.world.room(), touch.world.body(), object), first_(touch.world.pose()) {
    visit_.object = touch.world.room().furniture[static_cast<std::size_t>(object)].name;
    object_ = object;
  }

  Visit visit() {
    constexpr double kPatience_s = 240.0;
    if (touch_.begin() && choose_way())
      while (!visit_.has_arrived && touch_.world.time_s() < kPatience_s) step();
    if (visit_.has_arrived) feel();
    visit_.time_s = touch_.world.time_s();
    visit_.robot_touched = touch_.world.has_touched();
    const FloorPose is = touch_.world.pose(), believed = this->believed();
    visit_.lost_m = std::hypot(is.x_m - believed.x_m, is.y_m - believed.y_m);
    return visit_;
  }

 private:
  /// Where the robot is by its odometry.
  FloorPose believed() const {
    const FloorPose& moved = touch_.world.odometry();
    const double c = std::cos(first_.heading_rad), s = std::sin(first_.heading_rad);
    return {first_.x_m + c * moved.x_m - s * moved.y_m, first_.y_m + s * moved.x_m + c * moved.y_m,
            first_.heading_rad + moved.heading_rad};
  }
  bool choose_way() {
    way_ = plan_.way_from(believed());
    next_ = 0;
    rested_s_ = 0.0;
    return !way_.empty();
  }
  /// The share of the hand's way that asks for this share of the greatest speed.
  static double hand_for(double share) {
    if (std::abs(share) < 0.02) return 0.0;
    const double most = std::clamp(share, -1.0, 1.0);
    return std::copysign(session::kDeadZone + (1.0 - session::kDeadZone) * std::abs(most), most);
  }
  static double turn_to(const FloorPose& from, const Place& to) {
    return std::remainder(std::atan2(to.y_m - from.y_m, to.x_m - from.x_m) - from.heading_rad, 2.0 * M_PI);
  }

  void step() {
    constexpr double kLookahead_m = 0.3, kAt_m = 0.08, kFacing_rad = 0.06, kStraight_rad = 0.35;
    const FloorPose at = believed();
    const auto away_m = [&](const Place& p) { return std::hypot(p.x_m - at.x_m, p.y_m - at.y_m); };
    while (next_ + 1 < way_.size() && away_m(way_[next_]) < kLookahead_m) ++next_;
    const bool is_there = next_ + 1 == way_.size() && away_m(way_.back()) < kAt_m;
    arrived_ = arrived_ || is_there;
    const double turn_rad = turn_to(at, arrived_ ? plan_.object_place() : way_[next_]);
    session::DriveHand hand{hand_for(-2.0 * turn_rad), 0.0};
    if (arrived_ && std::abs(turn_rad) < kFacing_rad) {
      visit_.has_arrived = true;
      hand = {};
    } else if (!arrived_ && std::abs(turn_rad) < kStraight_rad) {
      hand.ahead = hand_for(std::clamp(away_m(way_.back()) / 0.5, 0.15, 1.0));
    }
    touch_.step(hand);
    visit_.way_m += 0.02 * touch_.world.motion().forward_m_per_s;
    notice_rest(hand.ahead > 0.0);
  }
  /// After some seconds in which the robot goes no farther the person tries another way, or is near enough.
  void notice_rest(bool drives) {
    constexpr double kRest_s = 4.0, kSlow_m_per_s = 0.01, kNear_m = 0.25;
    const bool rests = drives && touch_.world.motion().forward_m_per_s < kSlow_m_per_s;
    rested_s_ = rests ? rested_s_ + 0.02 : 0.0;
    if (rested_s_ < kRest_s) return;
    const FloorPose at = believed();
    if (std::hypot(way_.back().x_m - at.x_m, way_.back().y_m - at.y_m) < kNear_m) {
      arrived_ = true;
      rested_s_ = 0.0;
      return;
    }
    ++visit_.detours;
    plan_.close(at);
    if (!choose_way()) {
      plan_.reopen();
      choose_way();
    }
  }
  /// The hand goes to the middle of what is where the object is to be, in one picture of the live view.
  void feel() {
    constexpr double kAbout_m = 0.1, kFloor_m = 0.06;
    touch_.drive.set_mode(session::RobotMode::touch);
    for (int k = 0; k < 25; ++k) touch_.step({});
    const Pinhole camera = camera_of(240, 180, 1.52);
    const RoomView view = touch_.world.view(camera, {vision::DepthNoise{}, 0.25, 6.0, 0.0, 1});
    const FloorPose at = believed();
    const RobotBody& body = touch_.world.body();
    const auto world_from_camera =
        camera_pose({{at.x_m + body.camera_forward_m * std::cos(at.heading_rad),
                      at.y_m + body.camera_forward_m * std::sin(at.heading_rad), body.camera_height_m}},
                    at.heading_rad, body.camera_down_rad);
    std::vector<std::pair<int, int>> there;
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u) {
        const double z = view.depth_m(u, v);
        if (!std::isfinite(z)) continue;
        const Point<CameraFrame> seen{{z * (u - camera.cx) / camera.fx, z * (v - camera.cy) / camera.fy, z}};
        const auto point = world_from_camera * seen;
        if (point.v.z > kFloor_m && distance_m(plan_.object_alone(), point) < kAbout_m)
          there.emplace_back(u, v);
      }
    if (there.empty()) return;
    const auto [u, v] = middle_of(there);
    visit_.has_touched = view.object(u, v) == object_;
    const double z = view.depth_m(u, v);
    const Point<CameraFrame> touched{{z * (u - camera.cx) / camera.fx, z * (v - camera.cy) / camera.fy, z}};
    visit_.away_m = distance_m(plan_.object_alone(), touch_.world.world_from_camera() * touched);
  }
  /// The one that is nearest to the medians of both coordinates.
  static std::pair<int, int> middle_of(std::vector<std::pair<int, int>> pixels) {
    const auto median = [&](auto coordinate) {
      const auto middle = pixels.begin() + static_cast<std::ptrdiff_t>(pixels.size() / 2);
      std::nth_element(pixels.begin(), middle, pixels.end(),
                       [&](const auto& a, const auto& b) { return coordinate(a) < coordinate(b); });
      return coordinate(*middle);
    };
    const int u = median([](const auto& p) { return p.first; });
    const int v = median([](const auto& p) { return p.second; });
    const auto away = [&](const auto& p) { return std::hypot(p.first - u, p.second - v); };
    return *std::min_element(pixels.begin(), pixels.end(),
                             [&](const auto& a, const auto& b) { return away(a) < away(b); });
  }

  Telepresence& touch_;
  RoomPlan plan_;
  FloorPose first_;
  int object_ = 0;
  std::vector<Place> way_;
  std::size_t next_ = 0;
  bool arrived_ = false;
  double rested_s_ = 0.0;
  Visit visit_;
};

/// The person of this room visits the piece of furniture on its floor to which the way is longest.
inline Visit visit_in_room(std::uint64_t seed) {
  Telepresence touch(seed);
  const Room& room = touch.world.room();
  std::size_t longest = 0;
  int object = 0;
  for (std::size_t k = 0; k < room.furniture.size(); ++k) {
    if (!stands_on_floor(room.furniture[k])) continue;
    const RoomPlan plan(room, touch.world.body(), static_cast<int>(k));
    const std::size_t way = plan.way_from(touch.world.pose()).size();
    if (way <= longest) continue;
    longest = way;
    object = static_cast<int>(k);
  }
  return longest > 0 ? Person(touch, object).visit() : Visit{};
}

}  // namespace palpable::study
