// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/moved_workspace.hpp"

#include "palpable/haptics/safety/limits.hpp"
#include "palpable/haptics/safety/stability.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::haptics {
namespace {

/// A faster hand is none: the cushion begins anew.
constexpr double kFastest_m_per_s = 2.5;
/// The cushion's force at the end of its zone, as a part of the device's greatest force.
constexpr double kCushionForce = 0.3;
/// Of the stiffness limit: walls leave this much of it (haptics/safety/stability.hpp).
constexpr double kCushionStiffness = 0.1;
/// Time constant with which the scene's speed follows the hand's depth in the zone.
constexpr double kSpeedFollows_s = 0.1;
/// Stiffness and damping grow from zero along this part of the zone.
constexpr double kFadesIn = 0.25;
/// The scene's movement slows down where the touch's force opposes it, and stops at this part of the device's
/// greatest force: a wall that comes nearer is not pressed into the hand.
constexpr double kStopForce = 0.2;

/// The cushion's spring on one axis: its stiffness grows along `fade_m`, then it is linear, and from `most_N`
/// on the force is constant.
struct Spring {
  double force_N = 0.0;
  double stored_J = 0.0;
};
Spring spring_at(double pressed_m, double stiffness_N_per_m, double fade_m, double most_N) {
  const double k = stiffness_N_per_m;
  if (pressed_m < fade_m) {
    const double force_N = 0.5 * k * pressed_m * pressed_m / fade_m;
    return {force_N, force_N * pressed_m / 3.0};
  }
  const double linear_end_m = std::max(fade_m, most_N / k + 0.5 * fade_m);
  const double linear_m = std::min(pressed_m, linear_end_m) - fade_m;
  const double force_N = k * (linear_m + 0.5 * fade_m);
  const double linear_J = 0.5 * k * linear_m * (linear_m + fade_m);
  return {force_N, k * fade_m * fade_m / 6.0 + linear_J + force_N * std::max(0.0, pressed_m - linear_end_m)};
}

/// The air beyond the scene that the border brings into reach, as a part of half the workspace's width: as
/// much as fit_workspace() leaves above a scene.
constexpr double kAirBeyond = 0.25;

/// A slack from which it falls to where the hand is.
constexpr Vec3 kFarBeyond_m{10.0, 10.0, 10.0};

double& axis_of(Vec3& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

Result<void> check(const WorkspaceOptions& options) {
  if (!(options.magnification >= 1.0 && options.magnification <= 10.0))
    return Error{ErrorCode::usage, "a scene is magnified 1 to 10 times", {}};
  for (const auto& button : {options.clutch_button, options.stop_button})
    if (button && (*button < 0 || *button > 31))
      return Error{ErrorCode::usage, "a device's buttons have the numbers 1 to 32", {}};
  if (options.clutch_button && options.clutch_button == options.stop_button)
    return Error{ErrorCode::usage, "the same button cannot be the clutch and end the force", {}};
  return {};
}

MovedWorkspace::MovedWorkspace(std::unique_ptr<device::Device> device, const WorkspaceOptions& options,
                               double rate_hz, std::shared_ptr<WorkspaceState> state)
    : device_(std::move(device)),
      options_(options),
      period_s_(1.0 / rate_hz),
      max_rise_N_(TickOptions{}.max_force_rate_N_per_s / rate_hz),
      state_(state != nullptr ? std::move(state) : std::make_shared<WorkspaceState>()) {
  const device::Traits& traits = device_->traits();
  Vec3 size = traits.workspace_m;
  double narrowest_m = size.x * kZone;
  const auto axes = static_cast<std::size_t>(traits.degrees_of_freedom);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const double width_m = axis_of(size, axis);
    // The clutch may also bring the border of a scene that fits to the middle of the workspace.
    const double reach = options.magnification - (options.clutch_button ? 0.0 : 1.0);
    axes_[axis] = {width_m / 2.0, kZone * width_m, reach * width_m / 2.0};
    narrowest_m = std::min(narrowest_m, axes_[axis].zone_m);
  }
  max_cushion_N_ = kCushionForce * traits.max_force_N;
  const double wanted = max_cushion_N_ / narrowest_m;
  const SafeContact limit = safe_contact(traits, rate_hz, 1.0, 1e6, 0.0);
  stiffness_N_per_m_ = std::min(wanted, kCushionStiffness * limit.stiffness_N_per_m);
  // Three times of what a held spring needs.
  damping_Ns_per_m_ = 1.5 * (2.0 * traits.delay_samples + 1.0) * stiffness_N_per_m_ * period_s_;
  if (!options.cushion) stiffness_N_per_m_ = damping_Ns_per_m_ = 0.0;
  delay_ = static_cast<std::size_t>(std::clamp<int>(traits.delay_samples, 0, kMostDelay));
  tell_offset();
}

void MovedWorkspace::tell_offset() noexcept {
  for (std::size_t axis = 0; axis < state_->offset_m.size(); ++axis)
    state_->offset_m[axis].store(axis_of(offset_m_, axis), std::memory_order_relaxed);
}

std::optional<device::ZeroWrite> MovedWorkspace::zero_write() const {
  const auto* guardable = dynamic_cast<const device::Guardable*>(device_.get());
  return guardable != nullptr ? guardable->zero_write() : std::nullopt;
}

void MovedWorkspace::forget() noexcept {
  position_m_.reset();
  speed_m_per_s_ = {};
  cushion_N_ = {};
}

bool MovedWorkspace::is_stopped(std::uint32_t buttons) noexcept {
  if (!options_.stop_button) return false;
  const bool is_pressed = (buttons >> *options_.stop_button & 1U) != 0;
  if (is_pressed && !was_stop_pressed_) state_->stopped.store(!state_->stopped.load());
  was_stop_pressed_ = is_pressed;
  return state_->stopped.load();
}

device::Reading MovedWorkspace::read() noexcept {
  device::Reading reading = device_->read();
  const bool stopped = is_stopped(reading.buttons);
  const Vec3 position_m = reading.position.v;
  const bool is_good = reading.status == device::Status::ok && is_finite(reading.position);
  const Vec3 moved_m = is_good && position_m_ ? position_m - *position_m_ : Vec3{};
  if (!is_good || norm(moved_m) > kFastest_m_per_s * period_s_ * 4.0) {
    forget();
    reading.position.v = position_m + offset_m_;
    reading.clutched = stopped;
    return reading;
  }
  const Sent& held = sent_[(newest_ + sent_.size() - delay_) % sent_.size()];
  reserve_J_ = std::min(kReserve_J, reserve_J_ + kRefill_W * period_s_ - dot(held.total_N.v, moved_m));
  if (!position_m_) {
    slack_m_ = kFarBeyond_m;
    observer_.begin(0.0, PassivityObserver::Beginning::from_no_force);
  }
  const bool is_clutched = options_.clutch_button && (reading.buttons >> *options_.clutch_button & 1U) != 0;
  reading.clutched = is_clutched || stopped;
  if (is_clutched)
    move_with_hand(moved_m);
  else
    drive(position_m);
  tell_offset();
  cushion(position_m, moved_m);
  position_m_ = position_m;
  reading.position.v = position_m + offset_m_;
  return reading;
}

void MovedWorkspace::move_with_hand(Vec3 moved_m) noexcept {
  speed_m_per_s_ = {};
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    const double reach_m = axes_[axis].reach_m;
    double& offset_m = axis_of(offset_m_, axis);
    offset_m = std::clamp(offset_m - axis_of(moved_m, axis), -reach_m, reach_m);
  }
}

double MovedWorkspace::driven_reach_m(std::size_t axis) const noexcept {
  const auto [half_m, zone_m, reach_m] = axes_[axis];
  const double scene_m = state_->scene_m[axis].load(std::memory_order_relaxed);
  return std::clamp(scene_m - half_m + zone_m + kAirBeyond * half_m, 0.0, reach_m);
}

void MovedWorkspace::drive(Vec3 position_m) noexcept {
  if (options_.magnification <= 1.0) return;
  const double energy = std::clamp(reserve_J_ / (0.5 * kReserve_J), 0.0, 1.0);
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    const double half_m = axes_[axis].half_m;
    const double zone_m = axes_[axis].zone_m;
    if (zone_m <= 0.0) continue;
    const double reach_m = driven_reach_m(axis);
    const double at_m = axis_of(position_m, axis);
    double& offset_m = axis_of(offset_m_, axis);
    const double depth = std::clamp((std::abs(at_m) - half_m + zone_m) / zone_m, 0.0, 1.0);
    // Slower towards the end of the scene.
    const double left = std::clamp((reach_m - std::copysign(offset_m, offset_m * at_m)) / zone_m, 0.0, 1.0);
    const double opposes_N = std::max(0.0, -std::copysign(1.0, at_m) * axis_of(touch_N_.v, axis));
    const double yields = std::max(0.0, 1.0 - opposes_N / (kStopForce * device_->traits().max_force_N));
    const double wanted =
        std::copysign(options_.drive_speed_m_per_s * depth * left * yields * energy * ramp_, at_m);
    double& speed = axis_of(speed_m_per_s_, axis);
    speed += (wanted - speed) * std::min(1.0, period_s_ / kSpeedFollows_s);
    // A clutch, or a larger scene before, may have brought it farther: it never jumps back.
    const double end_m = std::max(reach_m, std::abs(offset_m));
    offset_m = std::clamp(offset_m + speed * period_s_, -end_m, end_m);
  }
}

MovedWorkspace::Cushion MovedWorkspace::cushion_at(Vec3 position_m, Vec3 velocity_m_per_s) noexcept {
  Cushion cushion;
  const bool drives = options_.magnification > 1.0;
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    const auto [half_m, zone_m, reach_m] = axes_[axis];
    if (zone_m <= 0.0) continue;
    const double at_m = axis_of(position_m, axis);
    const double beyond_m = std::max(0.0, std::abs(at_m) - half_m + (drives ? zone_m : 0.0));
    double& slack_m = axis_of(slack_m_, axis);
    slack_m = std::min(slack_m, beyond_m);
    const double pressed_m = beyond_m - slack_m;
    if (pressed_m <= 0.0) continue;
    const double fade_m = kFadesIn * zone_m;
    const Spring spring = spring_at(pressed_m, stiffness_N_per_m_, fade_m, max_cushion_N_);
    const double damping = damping_Ns_per_m_ * std::min(1.0, pressed_m / fade_m);
    const double outward_m_per_s = std::copysign(1.0, at_m) * axis_of(velocity_m_per_s, axis);
    // The damper never pulls the hand outward.
    const double force_N = std::clamp(spring.force_N + damping * outward_m_per_s, 0.0, 2.0 * max_cushion_N_);
    axis_of(cushion.force_N, axis) = -std::copysign(force_N, at_m);
    cushion.stored_J += spring.stored_J;
    cushion.damping_Ns_per_m = std::max(cushion.damping_Ns_per_m, damping);
    cushion.contact = true;
  }
  return cushion;
}

void MovedWorkspace::cushion(Vec3 position_m, Vec3 moved_m) noexcept {
  if (stiffness_N_per_m_ <= 0.0) return;
  // Without force the spring begins where the hand is.
  if (ramp_ <= 0.0) slack_m_ = kFarBeyond_m;
  const Vec3 velocity_m_per_s = (1.0 / period_s_) * moved_m;
  const Cushion now = cushion_at(position_m, velocity_m_per_s);
  PassivityObserver::Step step;
  step.held_force_N = sent_[(newest_ + sent_.size() - delay_) % sent_.size()].cushion_N;
  step.moved_m.v = moved_m;
  step.dt_s = period_s_;
  step.stored_J = ramp_ * now.stored_J;
  step.damping_Ns_per_m = ramp_ * now.damping_Ns_per_m;
  step.contact = now.contact;
  step.shortened = ramp_ < 1.0;
  observer_.update(step);
  Vector<DeviceFrame> force_N;
  force_N.v = ramp_ * now.force_N;
  Vector<DeviceFrame> velocity;
  velocity.v = velocity_m_per_s;
  cushion_N_ = control_passivity(force_N, velocity, observer_.made_J(), period_s_);
}

void MovedWorkspace::write(Vector<DeviceFrame> force_N) noexcept {
  // The ramp of this tick is known only now: a pause and a cut force end the cushion too.
  if (ramp_ <= 0.0) cushion_N_ = {};
  // What the touch's own rise leaves of the limit.
  const double left_N = std::max(0.0, max_rise_N_ - norm(force_N.v - touch_N_.v));
  const Sent& before = sent_[newest_];
  cushion_N_ = cap_rise(cushion_N_, before.cushion_N, left_N).force_N;
  touch_N_ = force_N;
  const auto total_N = bounded(force_N + cushion_N_, device_->traits().max_force_N);
  newest_ = (newest_ + 1) % sent_.size();
  sent_[newest_] = {total_N, cushion_N_};
  device_->write(total_N);
}

}  // namespace palpable::haptics
