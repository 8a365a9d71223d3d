// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/robot/robot_drive.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace palpable::session {
namespace {

/// The share of the greatest command at this share of the way to the border.
double beyond_dead_zone(double share) {
  const double size = (std::abs(std::clamp(share, -1.0, 1.0)) - kDeadZone) / (1.0 - kDeadZone);
  return size > 0.0 ? std::copysign(size, share) : 0.0;
}

/// The greatest speed from which a robot stands within `way_m`: v t + v^2 / (2 a) = way.
double speed_that_stops_in(double way_m, double reaction_s, double braking_m_per_s2) {
  const double a = braking_m_per_s2;
  return std::max(0.0, a * (std::sqrt(reaction_s * reaction_s + 2.0 * way_m / a) - reaction_s));
}

/// A picture of which less is known shows no way.
constexpr double kLeastKnown = 0.1;

double share_known(const Raster<float>& depth_m) {
  const auto known = std::count_if(depth_m.values().begin(), depth_m.values().end(),
                                   [](float z) { return std::isfinite(z); });
  return depth_m.count() > 0 ? static_cast<double>(known) / static_cast<double>(depth_m.count()) : 0.0;
}

/// Towards `wanted`: away from zero by at most `most`, to zero at once.
double grown(double from, double wanted, double most) {
  if (from * wanted <= 0.0) from = 0.0;
  return std::abs(wanted) <= std::abs(from)
             ? wanted
             : std::copysign(std::min(std::abs(wanted), std::abs(from) + most), wanted);
}

}  // namespace

Result<void> check(const DriveOptions& options) {
  const auto usage = [](const char* message) { return Error{ErrorCode::usage, message, {}}; };
  const RobotShape& shape = options.shape;
  const auto is_in = [](double value, double least, double most) { return value >= least && value <= most; };
  if (!is_in(options.speed_m_per_s, 0.05, 1.0)) return usage("a robot's speed is 0.05 to 1 m/s");
  if (!is_in(options.turn_rad_per_s, 0.1, 2.0)) return usage("a robot turns by 0.1 to 2 rad/s");
  if (!is_in(options.reaction_s, 0.0, 2.0)) return usage("a robot's reaction takes 0 to 2 s");
  if (!is_in(shape.radius_m, 0.05, 1.0) || !is_in(shape.height_m, 0.05, 2.5))
    return usage("a robot has a radius of 0.05 to 1 m and a height of 0.05 to 2.5 m");
  if (!is_in(shape.camera_height_m, 0.05, 2.5) || !is_in(shape.camera_forward_m, -1.0, 1.0) ||
      !is_in(shape.camera_left_m, -1.0, 1.0) || !is_in(shape.camera_down_rad, -0.5, 1.2))
    return usage(
        "a robot's camera is 0.05 to 2.5 m above the floor, at most 1 m from its axis, and looks down by -28 "
        "to 68 degrees");
  return {};
}

RobotDrive::RobotDrive(const DriveOptions& options)
    : options_(options), map_(options.shape), vouched_m_(options.shape.radius_m + options.margin_m) {}

bool RobotDrive::start(double t_s) {
  if (obstacle_to_start(t_s)) return false;
  map_.begin(pose_, vouched_m_);
  last_ = {};
  started_ = true;
  was_centred_ = is_in_dead_zone();
  return true;
}

void RobotDrive::set_mode(RobotMode mode) {
  if (mode != mode_) was_centred_ = is_in_dead_zone();
  mode_ = mode;
}

bool RobotDrive::is_in_dead_zone() const {
  return hand_at_s_ && std::max(std::abs(hand_.right), std::abs(hand_.ahead)) <= kDeadZone;
}

std::optional<DriveLimit> RobotDrive::obstacle_to_start(double t_s) const {
  if (is_old(odometry_at_s_, t_s)) return DriveLimit::link_lost;
  if (is_picture_old(t_s)) return DriveLimit::picture_lost;
  return std::nullopt;
}

/// Of the odometry that was measured next; the newest if the robot's clock does not say it.
std::optional<RobotPose> RobotDrive::pose_at(std::optional<double> stamp_s) const {
  if (!odometry_at_s_) return std::nullopt;
  if (!stamp_s) return pose_;
  const auto next = std::lower_bound(past_.begin(), past_.end(), *stamp_s,
                                     [](const auto& past, double stamp) { return past.first < stamp; });
  return next == past_.end() ? pose_ : next->second;
}

std::optional<double> RobotDrive::picture_age_s(double t_s) const {
  return picture_at_s_ ? std::optional(std::max(0.0, t_s - *picture_at_s_)) : std::nullopt;
}

void RobotDrive::take_odometry(double t_s, const RobotPose& pose, std::optional<double> stamp_s) {
  constexpr double kKept_s = 2.0;
  pose_ = pose;
  odometry_at_s_ = t_s;
  if (!stamp_s) return;
  // A clock that was set back.
  if (!past_.empty() && *stamp_s < past_.back().first) past_.clear();
  past_.emplace_back(*stamp_s, pose);
  while (*stamp_s - past_.front().first > kKept_s) past_.pop_front();
}

bool RobotDrive::is_frozen(const Raster<float>& depth_m) {
  constexpr double kMoved_m = 0.02, kMoved_rad = 0.02;
  const bool is_same =
      last_depth_m_.width() == depth_m.width() && last_depth_m_.height() == depth_m.height() &&
      std::memcmp(last_depth_m_.data(), depth_m.data(), depth_m.count() * sizeof(float)) == 0;
  if (is_same)
    return std::hypot(pose_.x_m - last_depth_pose_.x_m, pose_.y_m - last_depth_pose_.y_m) > kMoved_m ||
           std::abs(std::remainder(pose_.heading_rad - last_depth_pose_.heading_rad, 2.0 * M_PI)) >
               kMoved_rad;
  last_depth_m_ = depth_m;
  last_depth_pose_ = pose_;
  return false;
}

void RobotDrive::take_picture(double t_s, const DepthMap& depth, std::optional<double> stamp_s) {
  // Of an older one the robot may have left the place.
  constexpr double kOldest_s = 0.5;
  if (!depth.camera || !odometry_at_s_) return;
  if (stamp_s && !past_.empty() && past_.back().first - *stamp_s > kOldest_s) return;
  if (share_known(depth.depth_m) < kLeastKnown || is_frozen(depth.depth_m)) return;
  vouched_m_ = std::max(vouched_m_, map_.nearest_floor_m(*depth.camera));
  map_.add(depth, pose_at(stamp_s).value_or(pose_));
  constexpr std::size_t kIntervals = 9;
  if (picture_at_s_) picture_intervals_s_.push_back(t_s - *picture_at_s_);
  if (picture_intervals_s_.size() > kIntervals) picture_intervals_s_.pop_front();
  picture_at_s_ = t_s;
}

void RobotDrive::take_hand(double t_s, const DriveHand& hand) {
  hand_ = hand;
  hand_at_s_ = t_s;
  was_centred_ = was_centred_ || is_in_dead_zone();
}

void RobotDrive::release_hand() {
  hand_at_s_.reset();
  was_centred_ = false;
}

bool RobotDrive::is_old(const std::optional<double>& at_s, double t_s) const {
  return !at_s || t_s - *at_s > options_.lost_s;
}

bool RobotDrive::is_picture_old(double t_s) const {
  constexpr double kIntervals = 2.5, kOldest_s = 0.4;
  if (!is_old(picture_at_s_, t_s)) return false;
  if (!picture_at_s_ || picture_intervals_s_.empty()) return true;
  auto sorted = picture_intervals_s_;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return t_s - *picture_at_s_ > std::min(kIntervals * *middle, kOldest_s);
}

std::optional<DriveLimit> RobotDrive::reason_to_stand(double t_s) const {
  if (!started_) return DriveLimit::not_started;
  if (const auto lost = obstacle_to_start(t_s)) return lost;
  if (is_old(hand_at_s_, t_s) || !std::isfinite(hand_.right) || !std::isfinite(hand_.ahead))
    return DriveLimit::released;
  if (mode_ == RobotMode::touch) return DriveLimit::standing;
  return was_centred_ ? std::nullopt : std::optional(DriveLimit::off_centre);
}

RobotVelocity RobotDrive::asked(const DriveHand& hand) const {
  const double forward = mode_ == RobotMode::drive ? std::max(0.0, beyond_dead_zone(hand.ahead)) : 0.0;
  return {options_.speed_m_per_s * forward, -options_.turn_rad_per_s * beyond_dead_zone(hand.right)};
}

double RobotDrive::allowed_m_per_s(double turn_rad_per_s, double forward_m_per_s) const {
  if (!(forward_m_per_s > 0.0)) return 0.0;
  // However slow it is, what is just ahead counts.
  constexpr double kJustAhead_m = 0.05;
  const double longest_m = kJustAhead_m + forward_m_per_s * options_.reaction_s +
                           forward_m_per_s * forward_m_per_s / (2.0 * options_.braking_m_per_s2);
  // A turn on the spot moves nothing of a cylinder, so narrow arcs are no more than that.
  constexpr double kSharpest_per_m = 20.0;
  const double turn_per_m = std::clamp(turn_rad_per_s / forward_m_per_s, -kSharpest_per_m, kSharpest_per_m);
  const double way_m = map_.free_distance_m(pose_, turn_per_m, options_.margin_m, longest_m);
  return std::min(forward_m_per_s,
                  speed_that_stops_in(way_m, options_.reaction_s, options_.braking_m_per_s2));
}

RobotDrive::Command RobotDrive::command(double t_s) {
  const double dt_s = std::clamp(t_s - last_at_s_, 0.0, options_.lost_s);
  last_at_s_ = t_s;
  if (const auto reason = reason_to_stand(t_s)) {
    last_ = {};
    return {{}, *reason};
  }
  const RobotVelocity wanted = asked(hand_);
  const double turn = grown(last_.turn_rad_per_s, wanted.turn_rad_per_s, options_.growth_rad_per_s2 * dt_s);
  const double forward =
      grown(last_.forward_m_per_s, wanted.forward_m_per_s, options_.growth_m_per_s2 * dt_s);
  // Along its present arc, straight on, and along the one that the hand asks for: the robot may be between
  // them when it brakes.
  double allowed = allowed_m_per_s(turn, forward);
  for (const double other : {0.0, last_.turn_rad_per_s, wanted.turn_rad_per_s})
    allowed = std::min(allowed, allowed_m_per_s(other, forward));
  last_ = {allowed, turn};
  return {last_, allowed < forward ? DriveLimit::obstacle : DriveLimit::none};
}

}  // namespace palpable::session
