// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/result.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace palpable::device {

/// What is known of a device; stability limits are computed from it. NaN where unknown. Units are in the
/// names.
struct Traits {
  std::string name;
  /// 2: forces and positions in the plane (x, y), z is always 0. 3: all three axes.
  int degrees_of_freedom = 3;
  /// Full width, height and depth of the workspace, centred on the device frame's origin.
  Vec3 workspace_m{0.10, 0.10, 0.05};
  double max_force_N = 3.0;
  double mass_kg = std::numeric_limits<double>::quiet_NaN();
  double damping_Ns_per_m = std::numeric_limits<double>::quiet_NaN();
  double coulomb_friction_N = std::numeric_limits<double>::quiet_NaN();
  double position_resolution_m = std::numeric_limits<double>::quiet_NaN();
  /// Samples between reading a position and the force that answers it reaching the motors.
  int delay_samples = 0;
  double rate_hz = 1000.0;
  /// False for what has no motors (the page's pointer): forces are shown, heard and drawn only.
  bool pushes_back = true;
  /// Its places come as messages: while none differs from the one before, it need not be read in every tick
  /// (haptics::ServoOptions::rest_after_s).
  bool may_rest = false;
  /// Reads how its handle is turned (Reading::rotation) and takes torques (Device::write_torque()).
  bool has_torque = false;
  double max_torque_Nm = 0.0;
  /// Of the handle's turning, about any axis; NaN where unknown.
  double inertia_kg_m2 = std::numeric_limits<double>::quiet_NaN();
  double rotational_damping_Nm_s = std::numeric_limits<double>::quiet_NaN();
};

enum class Status : std::uint8_t {
  ok,
  /// Open but not homed or calibrated: no position-based force may be sent yet.
  not_ready,
  /// The last position is old: nothing new came in time.
  stale,
  /// The device failed; fault() says how.
  fault
};

/// When a tick of a recording was, and its flags (haptics::flag): who repeats a recording gives them with the
/// reading, and the tick takes them in place of the clock's, so that the same readings give the same forces.
struct RecordedTime {
  double t_s = 0.0;
  double dt_s = 0.001;
  std::uint32_t flags = 0;
};

/// Row-major, orthonormal, determinant +1.
using Rotation = std::array<double, 9>;
inline constexpr Rotation kNotTurned{1, 0, 0, 0, 1, 0, 0, 0, 1};

struct Reading {
  Point<DeviceFrame> position;
  Status status = Status::ok;
  /// Bit k = button k is down.
  std::uint32_t buttons = 0;
  /// Of the handle, device from tool, where Traits::has_torque.
  Rotation rotation = kNotTurned;
  std::optional<RecordedTime> recorded = std::nullopt;
};

/// A force-feedback device, or what stands in for one. Opened by open_device(); closed by its destructor,
/// which writes zero force first. read() and write() are called by one thread, once a tick, in that order:
/// they never allocate, lock or throw and return within the device's own exchange time.
class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  virtual const Traits& traits() const noexcept = 0;
  virtual Reading read() noexcept = 0;
  /// The force on the hand. Finite and capped by the caller.
  virtual void write(Vector<DeviceFrame> force_N) noexcept = 0;
  /// The torque on the hand about the handle's origin, which acts with the force of the next write(). Called
  /// only where Traits::has_torque.
  virtual void write_torque(Vector<DeviceFrame> /*torque_Nm*/) noexcept {}
  /// Zero force at once; safe from any state and more than once.
  virtual void stop() noexcept = 0;
  /// Zero force at once, for a watchdog: called by another thread while the servo's may be anywhere in read()
  /// or write(), or hang there. Must not wait for that thread; the servo's next write() counts again. A
  /// driver whose stop() may not be called so has one of its own.
  virtual void cut_force() noexcept { stop(); }
  /// What happened, after Status::fault; outside the tick.
  virtual std::string fault() const { return {}; }
};

}  // namespace palpable::device
