// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A change of scene: from one to the next by a cross-fade, with what the touch keeps.
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::haptics {
namespace {

bool is_same(const Transform<SceneFrame, DeviceFrame>& a, const Transform<SceneFrame, DeviceFrame>& b) {
  return a.rotation == b.rotation && a.translation_m == b.translation_m && a.scale == b.scale;
}

bool is_same(const LawOutput& a, const LawOutput& b) {
  const bool same_energy = a.stored_J == b.stored_J || (std::isnan(a.stored_J) && std::isnan(b.stored_J));
  return same_energy && a.contact == b.contact && a.force_N == b.force_N && a.torque_Nm == b.torque_Nm &&
         a.spring_N == b.spring_N && a.spring_torque_Nm == b.spring_torque_Nm && a.guide_N == b.guide_N;
}

/// Pictures lift a hand by kLift_m_per_s (session/touch/rising_surface.hpp). Between two of them it is a
/// little faster, so that it has arrived when the next one comes.
constexpr double kMoves_m_per_s = 1.1 * kLift_m_per_s;
/// The velocity of a surface is eased over this time, so that a damper does not notice that pictures come one
/// by one.
constexpr double kEase_s = 0.010;
constexpr double kStands_m_per_s = 1e-5;

}  // namespace

bool TickPipeline::evaluate_laws(double dt_s) noexcept {
  if (counts_.ticks == 0) flags_ |= flag::kNewTouch;
  const bool finite = evaluate_law(now_, dt_s) && (!fading() || evaluate_law(coming_, dt_s));
  if (!finite) {
    flags_ |= flag::kNotFinite;
    return false;
  }
  law_force_N_ = device_force_N(now_, now_.output.force_N);
  guide_N_ = device_force_N(now_, now_.output.guide_N);
  if (has_torque_) law_torque_Nm_ = device_torque_Nm(now_, now_.output.torque_Nm);
  if (fading()) blend_laws();
  if (moves_ || surface_m_per_s_ != Vector<DeviceFrame>{}) meet_moving_surface(dt_s);
  return true;
}

void TickPipeline::blend_laws() noexcept {
  law_force_N_ += faded_ * (device_force_N(coming_, coming_.output.force_N) - law_force_N_);
  guide_N_ += faded_ * (device_force_N(coming_, coming_.output.guide_N) - guide_N_);
  if (has_torque_)
    law_torque_Nm_ += faded_ * (device_torque_Nm(coming_, coming_.output.torque_Nm) - law_torque_Nm_);
}

SurfaceAtHand TickPipeline::surface_of(const Side& side) const noexcept {
  const Hand hand{side.scene->scene_from_device * position_, {}};
  return surface_at_hand(*side.scene->touchable, hand, side.state, side.output);
}

/// The spring of the surface between both, with the mean of the dampers of those that the hand touches: their
/// share of the mean would leave the spring with a part of its damper. It never pulls.
void TickPipeline::take_force_between() noexcept {
  const double share = between_.share;
  if (share > 0.0 && share < 1.0) {
    const Vector<SceneFrame> springs_N = from_.spring_N + faded_ * (to_.spring_N - from_.spring_N);
    const Vector<DeviceFrame> mean_N = device_force_N(now_, springs_N);
    const Vector<DeviceFrame> spring_N = share * mean_N;
    const Vector<DeviceFrame> rest_N = (1.0 / between_.touched) * (law_force_N_ - guide_N_ - mean_N);
    law_force_N_ = spring_N + rest_N;
    if (dot(law_force_N_, spring_N) <= 0.0) law_force_N_ = {};
    law_force_N_ += share * guide_N_;
  } else {
    law_force_N_ = share * law_force_N_;
  }
  guide_N_ = share * guide_N_;
}

/// The force is that of the surface between both. Its velocity, for the next tick, is that of the places
/// which the springs pull to: of a height map that rises they go up where friction holds them; where the hand
/// slides, only what they move along the normal is known.
void TickPipeline::meet_moving_surface(double dt_s) noexcept {
  Vector<DeviceFrame> velocity_m_per_s;
  if (moves_) {
    // A hand that touches neither need not know how far they are.
    const bool touches = now_.output.contact || coming_.output.contact;
    from_ = touches ? surface_of(now_) : SurfaceAtHand{};
    to_ = touches ? surface_of(coming_) : SurfaceAtHand{};
    // On its way to the hand it may be faster than it lifts it.
    const bool meets = !between_.contact;
    between_ = surface_between(from_, to_, faded_);
    take_force_between();
    law_torque_Nm_ = between_.share * law_torque_Nm_;
    if (!meets) velocity_m_per_s = (1.0 / dt_s) * way_of_surface();
  }
  if (!is_in_contact()) {
    surface_m_per_s_ = {};
    return;
  }
  surface_m_per_s_ += dt_s / (dt_s + kEase_s) * (velocity_m_per_s - surface_m_per_s_);
  if (norm(surface_m_per_s_) < kStands_m_per_s) surface_m_per_s_ = {};
}

void TickPipeline::fade(double dt_s) noexcept {
  flags_ |= flag::kFading;
  faded_before_ = faded_;
  if (moves_ && faded_ > 0.0) {
    faded_ = moved_by(dt_s);
    return;
  }
  // How much deeper the hand is in the surface that comes than in the one that goes: a spring that stores U
  // at a force f is 2 U / f deep. A weight on a slope is not.
  const auto depth_m = [](const Side& side) {
    const double spring_N = norm(side.output.spring_N);
    return side.energy == EnergyModel::spring && side.output.contact && spring_N > 0.0
               ? 2.0 * side.output.stored_J / (spring_N * side.scene->scene_from_device.scale)
               : 0.0;
  };
  // In the first tick, the surface that comes has not been evaluated.
  const double rises_s = faded_ > 0.0
                             ? std::min((depth_m(coming_) - depth_m(now_)) / kLift_m_per_s, kLongestLift_s)
                             : kLongestLift_s;
  faded_ = std::min(1.0, faded_ + dt_s / std::max(options_.fade_s, rises_s));
}

double TickPipeline::moved_by(double dt_s) const noexcept {
  const double scale = now_.scene->scene_from_device.scale;
  const double rises_m = to_.depth_m - from_.depth_m;
  if (!(rises_m > 0.0)) return std::min(1.0, faded_ + dt_s / options_.fade_s);
  // It comes to the hand, and then lifts it: in the time of a picture if it may lift it that fast. What is
  // left of that time is for the way to the hand.
  const double meets = std::clamp(-from_.depth_m / rises_m, 0.0, 1.0);
  const double lifts_s = (1.0 - meets) * rises_m / (scale * kMoves_m_per_s);
  const double under_s = std::clamp(lifts_s, (1.0 - meets) * options_.fade_s, kLongestLift_s);
  const double above_s = std::max(options_.fade_s - under_s, dt_s);
  const double comes = faded_ < meets ? std::min(meets, faded_ + meets * dt_s / above_s) : faded_;
  return comes < meets ? comes : std::min(1.0, comes + (1.0 - meets) * dt_s / std::max(under_s, dt_s));
}

bool TickPipeline::is_changing() const noexcept {
  return fading() && !(same_surface_ && is_same(now_.output, coming_.output));
}

void TickPipeline::end_fade() noexcept {
  retired_ = now_.scene;
  now_ = coming_;
  coming_ = {};
  goes_on_ = moves_ = false;
  emit(TouchEvent::Kind::scene_changed, now_.scene->id);
}

void TickPipeline::change(const HapticScene& scene) noexcept {
  coming_.begin(scene);
  const bool is_same_place = is_same(scene.scene_from_device, now_.scene->scene_from_device);
  same_surface_ = is_same_place && scene.touchable->state_family() == now_.scene->touchable->state_family();
  if (same_surface_) {
    coming_.state = now_.state;
  } else if (is_same_place) {
    scene.touchable->take_over(now_.scene->touchable->hand_over(now_.state), coming_.state);
  }
  goes_on_ = is_same_place && scene.succession == Succession::moves && coming_.energy == now_.energy &&
             (now_.energy == EnergyModel::spring || now_.energy == EnergyModel::weight);
  moves_ = goes_on_ && !same_surface_ && now_.energy == EnergyModel::spring;
  if (moves_) {
    from_ = to_ = surface_of(now_);
    between_ = surface_between(from_, to_, 0.0);
  }
  faded_ = 0.0;
  const double held_J = given_J(rise_);
  stored_before_change_J_ = std::isfinite(held_J) ? held_J : 0.0;
  change_work_J_ = change_brought_J_ = 0.0;
}

const HapticScene* TickPipeline::take_retired() noexcept { return std::exchange(retired_, nullptr); }

}  // namespace palpable::haptics
