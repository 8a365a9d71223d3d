// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/robot_hand.hpp"

#include "palpable/session/robot/drive_surface.hpp"
#include "palpable/session/touch/touch_session.hpp"

#include <utility>

namespace palpable::session {

void RobotHand::begin(TouchSession& session) {
  touch_law_ = session.settings().law;
  session_ = &session;
  law_is_set_ = false;
}

void RobotHand::end() {
  session_ = nullptr;
  const std::lock_guard lock(using_session_);
}

void RobotHand::change_mode(RobotMode mode) {
  mode_ = mode;
  law_is_set_ = false;
}

void RobotHand::follow_law() {
  const std::lock_guard use(using_session_);
  TouchSession* session = session_;
  if (session == nullptr || law_is_set_.exchange(true)) return;
  TouchSettings settings = session->settings();
  settings.law = touch_law_;
  if (mode_ != RobotMode::touch) (settings.law = {}).law = haptics::Law::rolling;
  static_cast<void>(session->change_settings(settings));
}

RobotHand::Now RobotHand::now() {
  const std::lock_guard use(using_session_);
  TouchSession* session = session_;
  if (session == nullptr || session->paused()) return {std::nullopt, true};
  const auto sample = session->latest();
  if (sample.status != device::Status::ok) return {std::nullopt, true};
  // A servo that stands still says nothing of the hand.
  if (std::exchange(last_tick_, sample.tick) == sample.tick) return {std::nullopt, false};
  const auto scene = session->scene();
  const Vec3 at = sample.position.v;
  return {drive_hand_at(at.x, at.y, *models::relief_of(*scene)), false};
}

}  // namespace palpable::session
