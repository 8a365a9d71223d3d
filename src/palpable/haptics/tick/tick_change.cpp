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

/// No surface takes longer to rise under a hand.
constexpr double kLongest_s = 1.0;

}  // namespace

void TickPipeline::fade(double dt_s) noexcept {
  flags_ |= flag::kFading;
  faded_before_ = faded_;
  // How much deeper the hand is in the surface that comes than in the one that goes: a spring that stores U
  // at a force f is 2 U / f deep.
  const auto depth_m = [](const Side& side) {
    const double spring_N = norm(side.output.spring_N);
    return side.output.contact && spring_N > 0.0
               ? 2.0 * side.output.stored_J / (spring_N * side.scene->scene_from_device.scale)
               : 0.0;
  };
  // In the first tick, the surface that comes has not been evaluated.
  const double rises_s =
      faded_ > 0.0 ? std::min((depth_m(coming_) - depth_m(now_)) / kLift_m_per_s, kLongest_s) : kLongest_s;
  faded_ = std::min(1.0, faded_ + dt_s / std::max(options_.fade_s, rises_s));
}

bool TickPipeline::is_changing() const noexcept {
  return fading() && !(same_surface_ && is_same(now_.output, coming_.output));
}

void TickPipeline::end_fade() noexcept {
  retired_ = now_.scene;
  now_ = coming_;
  coming_ = {};
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
  faded_ = 0.0;
  const double held_J = given_J(rise_);
  stored_before_change_J_ = std::isfinite(held_J) ? held_J : 0.0;
  change_work_J_ = change_brought_J_ = 0.0;
}

const HapticScene* TickPipeline::take_retired() noexcept { return std::exchange(retired_, nullptr); }

}  // namespace palpable::haptics
