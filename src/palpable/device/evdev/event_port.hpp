// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <linux/input.h>

namespace palpable::device {

/// What a device of the kernel's event interface can do, as far as the driver needs it.
struct EventAbilities {
  std::string name;
  /// Least and greatest value of the axes X and Y.
  std::array<std::array<int, 2>, 2> range{};
  bool has_axes = false;
  bool has_constant_force = false;
  bool has_rumble = false;

  /// The code of the first button.
  int first_button() const noexcept { return has_constant_force ? BTN_JOYSTICK : BTN_GAMEPAD; }
};

/// The kernel's event device, or a double of it. No function waits, allocates or throws after it was opened.
class EventPort {
 public:
  EventPort() = default;
  EventPort(const EventPort&) = delete;
  EventPort& operator=(const EventPort&) = delete;
  virtual ~EventPort() = default;

  virtual const EventAbilities& abilities() const noexcept = 0;
  /// Copies events that have happened to the start of `events` and returns their number.
  virtual std::size_t read(std::span<input_event> events) noexcept = 0;
  /// Writes the present values of the axes X and Y and of the first sixteen buttons as events and returns
  /// their number, at most 18; 0 if they cannot be read.
  virtual std::size_t current(std::span<input_event> events) noexcept = 0;
  /// Uploads an effect, or changes it if its id is not -1, and stores its id. False if the device refuses it.
  virtual bool upload(ff_effect& effect) noexcept = 0;
  virtual bool play(int effect_id, bool on) noexcept = 0;
  /// The device was unplugged.
  virtual bool lost() const noexcept = 0;
};

/// Opens /dev/input/eventN. Errors (device): not there, permission denied, no axes, no force feedback.
Result<std::unique_ptr<EventPort>> open_event_port(const std::string& path);

}  // namespace palpable::device
