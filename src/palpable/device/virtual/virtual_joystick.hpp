// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/device/evdev/event_port.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <span>

namespace palpable::device {

/// A joystick behind the kernel's interface: it plays one effect until its length has passed.
class VirtualJoystick final : public EventPort {
 public:
  explicit VirtualJoystick(bool pushes) {
    can_.name = "Virtual stick";
    can_.range = {{{-512, 511}, {0, 255}}};
    can_.has_axes = true;
    can_.has_constant_force = pushes;
    can_.has_rumble = !pushes;
  }
  const EventAbilities& abilities() const noexcept override { return can_; }
  std::size_t read(std::span<input_event> events) noexcept override {
    if (lost_) return 0;
    if (on_read) on_read();
    const std::size_t count = std::min(events.size(), waiting_);
    std::copy_n(queue_.begin(), count, events.begin());
    waiting_ = 0;
    return count;
  }
  std::size_t current(std::span<input_event> events) noexcept override {
    if (lost_) return 0;
    std::size_t count = 0;
    const auto put = [&](int type, int code, int value) { events[count++] = event_of(type, code, value); };
    put(EV_ABS, ABS_X, axes_[0]);
    put(EV_ABS, ABS_Y, axes_[1]);
    for (int k = 0; k < 16; ++k) put(EV_KEY, can_.first_button() + k, static_cast<int>(buttons_ >> k & 1U));
    return count;
  }
  bool upload(ff_effect& effect) noexcept override {
    if (lost_ || refuses_) return false;
    if (effect.id == -1) effect.id = 3;
    effect_ = effect;
    ++uploads_;
    if (on_upload) on_upload(effect);
    return true;
  }
  bool play(int id, bool on) noexcept override {
    if (lost_ || id != effect_.id) return false;
    left_ms_ = on ? effect_.replay.length : 0;
    return true;
  }
  bool lost() const noexcept override { return lost_; }

  /// Called before the events are read, and with each effect; may be empty.
  std::function<void()> on_read;
  std::function<void(const ff_effect&)> on_upload;

  void happen(int type, int code, int value) {
    hold(type, code, value);
    queue_.at(waiting_++) = event_of(type, code, value);
  }
  /// A change whose event is lost, with all that wait, because the reader was too slow.
  void overflow(int type, int code, int value) {
    hold(type, code, value);
    waiting_ = 0;
    queue_.at(waiting_++) = event_of(EV_SYN, SYN_DROPPED, 0);
    // What is left of the report that the loss began in.
    queue_.at(waiting_++) = event_of(EV_ABS, ABS_X, can_.range[0][0]);
    queue_.at(waiting_++) = event_of(EV_SYN, SYN_REPORT, 0);
  }
  void pass_millisecond() { left_ms_ = std::max(0, left_ms_ - 1); }
  /// What the motors do now: the force's share of the greatest one, in our axes.
  Vec3 push() const { return left_ms_ == 0 ? Vec3{} : push_of(effect_); }
  static Vec3 push_of(const ff_effect& effect) {
    if (effect.type != FF_CONSTANT) return {};
    // The kernel's angle: from "towards the user" to the left.
    const double angle = 2.0 * std::numbers::pi * effect.direction / 65536.0;
    const double share = effect.u.constant.level / 32767.0;
    return {-share * std::sin(angle), -share * std::cos(angle), 0.0};
  }
  double rumble() const {
    return left_ms_ == 0 || effect_.type != FF_RUMBLE ? 0.0 : effect_.u.rumble.strong_magnitude / 65535.0;
  }
  int uploads() const { return uploads_; }
  void unplug() { lost_ = true; }
  void refuse(bool refuses = true) { refuses_ = refuses; }

 private:
  static input_event event_of(int type, int code, int value) {
    input_event event{};
    event.type = static_cast<std::uint16_t>(type);
    event.code = static_cast<std::uint16_t>(code);
    event.value = value;
    return event;
  }
  void hold(int type, int code, int value) {
    if (type == EV_ABS && (code == ABS_X || code == ABS_Y)) axes_[code == ABS_X ? 0 : 1] = value;
    const int button = code - can_.first_button();
    if (type != EV_KEY || button < 0 || button >= 16) return;
    const std::uint32_t bit = 1U << button;
    buttons_ = value != 0 ? buttons_ | bit : buttons_ & ~bit;
  }

  EventAbilities can_;
  std::array<input_event, 64> queue_{};
  std::size_t waiting_ = 0;
  std::array<int, 2> axes_{0, 127};
  std::uint32_t buttons_ = 0;
  ff_effect effect_{};
  int left_ms_ = 0;
  int uploads_ = 0;
  bool lost_ = false;
  bool refuses_ = false;
};

}  // namespace palpable::device
