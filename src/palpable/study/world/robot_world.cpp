// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/robot_world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace palpable::study {
namespace {

/// A number of [0, 1), the same on every machine.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

/// About normal, of standard deviation 1: the sum of twelve uniform numbers.
double normal(std::mt19937_64& random) {
  double sum = -6.0;
  for (int k = 0; k < 12; ++k) sum += uniform(random);
  return sum;
}

bool fits(const Room& room, const RobotBody& body, double x_m, double y_m, double around_m) {
  return !touches(room, {x_m, y_m, body.radius_m + around_m, body.height_m});
}

/// A place with room around it. The middle of the room if there is none.
FloorPose free_place(const Room& room, const RobotBody& body, std::mt19937_64& random) {
  constexpr double kAround_m = 0.4;
  constexpr int kTries = 10'000;
  for (int k = 0; k < kTries; ++k) {
    const double x_m = (uniform(random) - 0.5) * room.size_m.x;
    const double y_m = (uniform(random) - 0.5) * room.size_m.y;
    if (fits(room, body, x_m, y_m, kAround_m)) return {x_m, y_m, 2.0 * std::numbers::pi * uniform(random)};
  }
  return {};
}

/// `from`, moved by a circular arc.
FloorPose moved(const FloorPose& from, double forward_m, double turn_rad) {
  const double middle_rad = from.heading_rad + 0.5 * turn_rad;
  return {from.x_m + forward_m * std::cos(middle_rad), from.y_m + forward_m * std::sin(middle_rad),
          from.heading_rad + turn_rad};
}

double towards(double from, double to, double most) { return from + std::clamp(to - from, -most, most); }

}  // namespace

RobotWorld::RobotWorld(Room room, const RobotBody& body, const RobotErrors& errors, std::uint64_t seed)
    : room_(std::move(room)), body_(body), errors_(errors), random_(seed) {
  pose_ = free_place(room_, body_, random_);
}

void RobotWorld::command(const WheelMotion& wanted) {
  if (!std::isfinite(wanted.forward_m_per_s) || !std::isfinite(wanted.turn_rad_per_s)) return;
  command_ = {std::clamp(wanted.forward_m_per_s, -body_.max_forward_m_per_s, body_.max_forward_m_per_s),
              std::clamp(wanted.turn_rad_per_s, -body_.max_turn_rad_per_s, body_.max_turn_rad_per_s)};
  commanded_at_s_ = time_s_;
}

void RobotWorld::place(const FloorPose& pose) {
  pose_ = pose;
  motion_ = {};
}

void RobotWorld::command_arm(double left_m_per_s) {
  if (!std::isfinite(left_m_per_s)) return;
  arm_command_m_per_s_ = std::clamp(left_m_per_s, -body_.arm.max_m_per_s, body_.arm.max_m_per_s);
  arm_commanded_at_s_ = time_s_;
}

WheelMotion RobotWorld::commanded() const {
  return time_s_ - commanded_at_s_ > body_.command_lasts_s ? WheelMotion{} : command_;
}

void RobotWorld::advance(double dt_s) {
  constexpr double kStep_s = 0.005;
  for (double left_s = dt_s; left_s > 1e-9; left_s -= kStep_s) step(std::min(left_s, kStep_s));
}

void RobotWorld::draw_errors() {
  slip_forward_ = 1.0 + errors_.slip * normal(random_);
  slip_turn_ = 1.0 + errors_.slip * normal(random_);
  odometry_forward_ = 1.0 + errors_.odometry * normal(random_);
  odometry_turn_ = 1.0 + errors_.odometry * normal(random_);
}

void RobotWorld::step(double dt_s) {
  constexpr double kDraw_s = 0.1;
  time_s_ += dt_s;
  if (time_s_ >= next_draw_s_) {
    draw_errors();
    next_draw_s_ += kDraw_s;
  }
  step_arm(dt_s);
  const WheelMotion wanted = commanded();
  motion_.forward_m_per_s =
      towards(motion_.forward_m_per_s, wanted.forward_m_per_s, body_.forward_m_per_s2 * dt_s);
  motion_.turn_rad_per_s =
      towards(motion_.turn_rad_per_s, wanted.turn_rad_per_s, body_.turn_rad_per_s2 * dt_s);
  const double forward_m = motion_.forward_m_per_s * dt_s, turn_rad = motion_.turn_rad_per_s * dt_s;
  odometry_ = moved(odometry_, odometry_forward_ * forward_m, odometry_turn_ * turn_rad);
  const FloorPose next = moved(pose_, slip_forward_ * forward_m, slip_turn_ * turn_rad);
  if (!fits(room_, body_, next.x_m, next.y_m, 0.0)) {
    has_touched_ = true;
    return;
  }
  pose_ = next;
}

void RobotWorld::step_arm(double dt_s) {
  const bool is_old = time_s_ - arm_commanded_at_s_ > body_.command_lasts_s;
  arm_m_per_s_ = towards(arm_m_per_s_, is_old ? 0.0 : arm_command_m_per_s_, body_.arm.m_per_s2 * dt_s);
  const double before_m = arm_m_;
  arm_m_ = std::clamp(arm_m_ + arm_m_per_s_ * dt_s, -body_.arm.reach_m, body_.arm.reach_m);
  if (distance_m(room_, {world_from_wrist().translation_m}) > body_.arm.radius_m) return;
  has_touched_ = true;
  arm_m_ = before_m;
}

Transform<WorldFrame, CameraFrame> RobotWorld::base_from_wrist() const {
  return camera_pose({{body_.arm.forward_m, arm_m_, body_.arm.height_m}}, 0.0, body_.arm.down_rad);
}

Transform<WorldFrame, CameraFrame> RobotWorld::measured_base_from_wrist() {
  auto measured = base_from_wrist();
  measured.translation_m.y += body_.arm.error_m * normal(random_);
  return measured;
}

Transform<WorldFrame, CameraFrame> RobotWorld::world_from_wrist() const {
  const Vec3 at = base_from_wrist().translation_m;
  const double c = std::cos(pose_.heading_rad), s = std::sin(pose_.heading_rad);
  return camera_pose({{pose_.x_m + c * at.x - s * at.y, pose_.y_m + s * at.x + c * at.y, at.z}},
                     pose_.heading_rad, body_.arm.down_rad);
}

Transform<WorldFrame, CameraFrame> RobotWorld::world_from_camera() const {
  const FloorPose at = moved(pose_, body_.camera_forward_m, 0.0);
  return camera_pose({{at.x_m, at.y_m, body_.camera_height_m}}, pose_.heading_rad, body_.camera_down_rad);
}

RoomView RobotWorld::wrist_view(const Pinhole& camera, const CameraNoise& noise) const {
  return render(room_, world_from_wrist(), camera, noise);
}

RoomView RobotWorld::right_view(const Pinhole& camera, const CameraNoise& noise) const {
  auto pose = world_from_camera();
  pose.translation_m += pose.rotate({body_.baseline_m, 0.0, 0.0});
  return render(room_, pose, camera, noise);
}

RoomView RobotWorld::view(const Pinhole& camera, const CameraNoise& noise) const {
  return render(room_, world_from_camera(), camera, noise);
}

}  // namespace palpable::study
