// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/device/evdev/event_port.hpp"
#include "palpable/device/motor_heat.hpp"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace palpable::device {

class DeviceUrl;
struct OpenOptions;

struct EvdevOptions {
  /// The greatest force of the device's motors, N, 0.1 to 40: the kernel states none.
  double max_force_N = 2.0;
  /// What the motors can hold for ever, N, 0.1 to 40; kNoForce_N: an assumption (continuous_force()).
  double continuous_force_N = kNoForce_N;
  /// Time between two new positions of the stick, 0 to 0.1; 0 = unknown.
  double sensor_period_s = 0.0;
  /// Width and height of the workspace, metres, 0.01 to 1: the way of the stick's grip.
  double size_m = 0.10;
  /// Rate of the servo, Hz.
  double rate_hz = 1000.0;
};

/// A joystick with motors, or a gamepad that rumbles (docs/devices.md): the plane, x to the right and y away
/// from the user. Joysticks get the force as a constant effect, gamepads its magnitude as rumble. Effects are
/// sent at most every kEffect_s and end by themselves after kEffectLasts_ms, in the kernel: a hanging or
/// killed program holds no force. stop() may be called by any thread; the effect then ends with the next
/// write(), or by itself.
class EvdevDevice final : public Device {
 public:
  static constexpr double kEffect_s = 0.004;
  static constexpr int kEffectLasts_ms = 10;

  EvdevDevice(std::unique_ptr<EventPort> port, const EvdevOptions& options);
  ~EvdevDevice() override;

  const Traits& traits() const noexcept override { return traits_; }
  Reading read() noexcept override;
  void write(Vector<DeviceFrame> force_N) noexcept override;
  void stop() noexcept override;
  std::string fault() const override;

 private:
  void take(const input_event& event) noexcept;
  void take_current() noexcept;
  bool send(Vec3 force_N) noexcept;

  std::unique_ptr<EventPort> port_;
  EvdevOptions options_;
  Traits traits_;
  ff_effect effect_{};
  Reading reading_;
  /// Since the kernel said that it lost events: what follows until the next report is incomplete.
  bool lost_events_ = false;
  double since_effect_s_ = kEffect_s;
  bool pushes_ = false;
  /// For how long it has refused effects.
  double refused_s_ = 0.0;
  std::atomic<bool> stopped_{false};
};

/// Opens `evdev:/dev/input/eventN?max-force=2&size-mm=100`; without a path the first device with force
/// feedback. Errors: usage (options), device.
Result<std::unique_ptr<Device>> open_evdev(DeviceUrl& url, const OpenOptions& options);

/// The event devices with axes and force feedback that may be opened, sorted.
Result<std::vector<std::string>> evdev_ports();

}  // namespace palpable::device
