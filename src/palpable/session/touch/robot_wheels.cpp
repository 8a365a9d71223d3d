// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/robot_wheels.hpp"

#include "palpable/session/robot/robot_messages.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include <fmt/format.h>

namespace palpable::session {

double RobotWheels::seconds_of(Clock::time_point time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

RobotWheels::RobotWheels(sources::RosbridgeClient& client, const Places& places, const DriveOptions& options,
                         RobotMode mode)
    : client_(client), places_(places), drive_(options) {
  drive_.set_mode(mode);
}

void RobotWheels::request_start() {
  const std::lock_guard lock(mutex_);
  asked_ = Asked::start;
}

void RobotWheels::request_stop() {
  const std::lock_guard lock(mutex_);
  asked_ = Asked::stop;
}

void RobotWheels::change_mode(RobotMode mode) {
  const std::lock_guard lock(mutex_);
  drive_.set_mode(mode);
  notices_.put(sentence_of(mode));
}

RobotDrive RobotWheels::drive() const {
  const std::lock_guard lock(mutex_);
  return drive_;
}

RobotMode RobotWheels::mode() const {
  const std::lock_guard lock(mutex_);
  return drive_.mode();
}

RobotPose RobotWheels::pose() const {
  const std::lock_guard lock(mutex_);
  return drive_.pose();
}

std::optional<RobotPose> RobotWheels::pose_at(std::optional<double> stamp_s) const {
  const std::lock_guard lock(mutex_);
  return drive_.pose_at(stamp_s);
}

RobotStatistics RobotWheels::statistics() const {
  const std::lock_guard lock(mutex_);
  RobotStatistics statistics = statistics_;
  statistics.picture_age = picture_ages_.summary();
  statistics.is_started = drive_.is_started();
  return statistics;
}

RobotState RobotWheels::state() const {
  const std::lock_guard lock(state_mutex_);
  return state_;
}

std::shared_ptr<const RobotFloor> RobotWheels::floor() const {
  const std::lock_guard lock(state_mutex_);
  return floor_;
}

void RobotWheels::publish_state(Clock::time_point now) {
  constexpr auto kFloorPeriod = std::chrono::milliseconds(500);
  const RobotState state = state_now(seconds_of(now));
  std::shared_ptr<const RobotFloor> floor;
  if (state.picture_age_s && now - floor_at_ >= kFloorPeriod) {
    floor = std::make_shared<const RobotFloor>(drive_.floor());
    floor_at_ = now;
  }
  const std::lock_guard lock(state_mutex_);
  state_ = state;
  if (floor) floor_ = std::move(floor);
}

RobotState RobotWheels::state_now(double now_s) const {
  const auto lack = drive_.obstacle_to_start(now_s);
  RobotState state;
  state.is_started = drive_.is_started();
  state.is_starting = asked_ == Asked::start && !state.is_started;
  state.moves = published_ != RobotVelocity{};
  state.mode = drive_.mode();
  state.limit = lasting_limit_;
  state.lacks = was_lost_                          ? RobotLack::link
                : lack == DriveLimit::link_lost    ? RobotLack::odometry
                : lack == DriveLimit::picture_lost ? RobotLack::picture
                                                   : RobotLack::nothing;
  state.event = event_;
  state.events = events_;
  state.vouched_m = drive_.vouched_m();
  state.battery = battery_;
  state.picture_age_s = drive_.picture_age_s(now_s);
  return state;
}

void RobotWheels::report(RobotEvent event) {
  event_ = event;
  ++events_;
  notices_.put(sentence_of(event, drive_.vouched_m()));
}

bool RobotWheels::stand() {
  const std::lock_guard lock(mutex_);
  return !has_commanded_ || client_.publish(places_.command, twist_text({}));
}

void RobotWheels::take_picture(Clock::time_point arrival, const DepthMap& depth,
                               std::optional<double> stamp_s) {
  const std::lock_guard lock(mutex_);
  drive_.take_picture(seconds_of(arrival), depth, stamp_s);
  // A picture that is newer than the odometry is younger than that can tell.
  if (stamp_s && odometry_stamp_s_)
    picture_ages_.record_ns(1e9 * std::max(0.0, *odometry_stamp_s_ - *stamp_s));
}

RobotNow RobotWheels::tick(Clock::time_point now, const RobotHand::Now& hand) {
  const std::lock_guard lock(mutex_);
  take_state();
  notice_stall(now);
  notice_loss(now);
  follow_wishes(seconds_of(now));
  if (hand.is_released) drive_.release_hand();
  if (hand.at) drive_.take_hand(seconds_of(now), *hand.at);
  const auto command = drive_.command(seconds_of(now));
  tell(command.limit, now);
  send(command.velocity, now);
  watch_motion(now);
  publish_state(now);
  // As the wheels in the other modes, the arm moves only while nothing else makes the robot stand.
  return {seconds_of(now), drive_.mode(), drive_.is_started(), command.limit == DriveLimit::standing,
          drive_.pose()};
}

void RobotWheels::take_state() {
  if (const auto newest = client_.take(places_.odometry))
    if (const auto* at = std::get_if<sources::RosOdometry>(&newest->message.body)) {
      drive_.take_odometry(seconds_of(newest->arrival), {at->x_m, at->y_m, at->yaw_rad},
                           newest->message.stamp_s);
      odometry_stamp_s_ = newest->message.stamp_s;
      measured_ = {measured_time_.of(seconds_of(newest->arrival), odometry_stamp_s_), drive_.pose(),
                   at->forward_m_per_s};
    }
  if (const auto newest = client_.take(places_.contact))
    if (const auto* touches = std::get_if<sources::RosFlag>(&newest->message.body))
      take_contact(touches->value);
  if (const auto newest = client_.take(places_.battery))
    if (const auto* battery = std::get_if<sources::RosBattery>(&newest->message.body))
      take_battery(battery->charge);
}

void RobotWheels::take_contact(bool touches) {
  if (touches && !touches_) {
    drive_.stop();
    report(RobotEvent::touched);
  }
  touches_ = touches;
}

void RobotWheels::take_battery(double charge) {
  battery_ = charge;
  if (charge < kLowBattery && !std::exchange(said_battery_, true))
    notices_.put(fmt::format("The robot's battery is at {:.0f} %.", 100.0 * charge));
}

void RobotWheels::notice_loss(Clock::time_point now) {
  // It may have come back since the last tick.
  const std::uint64_t losses = client_.losses();
  const bool is_connected = client_.is_connected();
  const bool was_lost = std::exchange(losses_, losses) != losses || !is_connected;
  // The robot may still have the command of before the loss.
  const bool had_lost = std::exchange(was_lost_, was_lost);
  if (is_connected && (was_lost || had_lost) && has_commanded_) started_at_ = now;
  if (!was_lost) return;
  // A start that was asked for before is no start of what comes back.
  asked_ = Asked::nothing;
  if (drive_.is_started()) report(RobotEvent::link_lost);
  drive_.lose_link();
}

/// A program that stood still must not go on by itself.
void RobotWheels::notice_stall(Clock::time_point now) {
  constexpr auto kStall = std::chrono::milliseconds(500);
  const auto before = std::exchange(ticked_at_, now);
  if (!before || now - *before < kStall || !drive_.is_started()) return;
  drive_.stop();
  report(RobotEvent::stalled);
}

void RobotWheels::follow_wishes(double now_s) {
  if (asked_ == Asked::stop) {
    asked_ = Asked::nothing;
    if (drive_.is_started()) report(RobotEvent::stopped);
    drive_.stop();
  }
  constexpr double kPatience_s = 2.0;
  const bool is_asked = asked_ == Asked::start && !drive_.is_started();
  if (!is_asked || !start_asked_at_s_) start_asked_at_s_ = now_s;
  if (is_asked && now_s - *start_asked_at_s_ > kPatience_s) {
    asked_ = Asked::nothing;
    report(RobotEvent::not_ready);
  }
  if (asked_ == Asked::start && (drive_.is_started() || drive_.start(now_s))) {
    asked_ = Asked::nothing;
    report(RobotEvent::started);
  }
}

void RobotWheels::tell(DriveLimit limit, Clock::time_point now) {
  constexpr auto kLasting = std::chrono::milliseconds(500);
  if (limit != limit_) {
    limit_ = limit;
    limit_since_ = now;
    limit_is_said_ = false;
  }
  if (limit_is_said_ || now - limit_since_ < kLasting) return;
  limit_is_said_ = true;
  lasting_limit_ = limit;
  // What was lost for so long does not go on by itself.
  if (limit == DriveLimit::picture_lost || limit == DriveLimit::link_lost) {
    drive_.stop();
    report(limit == DriveLimit::picture_lost ? RobotEvent::picture_lost : RobotEvent::odometry_lost);
  }
  if (auto words = sentence_of(limit); !words.empty()) notices_.put(std::move(words));
}

void RobotWheels::send(const RobotVelocity& velocity, Clock::time_point now) {
  // For a second after the end, since a zero that is sent once may be lost.
  constexpr auto kAfter = std::chrono::seconds(1);
  if (drive_.is_started()) started_at_ = now;
  if (!started_at_ || (now - *started_at_ > kAfter && published_ == RobotVelocity{})) return;
  has_commanded_ = true;
  if (!client_.publish(places_.command, twist_text(velocity))) return;
  published_ = velocity;
  ++statistics_.commands;
  if (velocity != RobotVelocity{}) ++statistics_.moving_commands;
}

void RobotWheels::watch_motion(Clock::time_point now) {
  const auto event = watch_.look(seconds_of(now), published_, measured_, has_commanded_ && !was_lost_);
  if (!event) return;
  drive_.stop();
  report(*event);
}

}  // namespace palpable::session
