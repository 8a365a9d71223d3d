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

/// Properties of a device, from which stability limits are computed. Units are in the names. NaN = unknown,
/// where it is the default.
struct Traits {
  std::string name;
  /// 2: positions and forces in the plane (x, y); z is always 0. 3: all three axes.
  int degrees_of_freedom = 3;
  /// Full width, height and depth of the workspace, centred on the device frame's origin; each above 0.
  Vec3 workspace_m{0.10, 0.10, 0.05};
  /// Greatest force of each written force, above 0: what the device can give, or what a hand may be exposed
  /// to.
  double max_force_N = 3.0;
  /// Force that the motors can hold for ever without getting too hot; greater ones only for a while
  /// (haptics::HeatBudget). NaN: max_force_N for ever.
  double continuous_force_N = std::numeric_limits<double>::quiet_NaN();
  double mass_kg = std::numeric_limits<double>::quiet_NaN();
  double damping_Ns_per_m = std::numeric_limits<double>::quiet_NaN();
  double coulomb_friction_N = std::numeric_limits<double>::quiet_NaN();
  double position_resolution_m = std::numeric_limits<double>::quiet_NaN();
  /// Delay in samples from reading a position until the resulting force acts at the motors.
  int delay_samples = 0;
  double rate_hz = 1000.0;
  /// Time between two new positions, of a device that gives them more slowly than it is read; 0 = a new one
  /// in each tick.
  double sensor_period_s = 0.0;
  /// False for a device without motors (the page's pointer): its forces are only displayed and sonified.
  bool pushes_back = true;
  /// Positions arrive as messages. While they do not change, the device need not be read in every tick
  /// (haptics::ServoOptions::rest_after_s).
  bool may_rest = false;
  /// Measures its handle's orientation (Reading::rotation) and takes torques (Device::write_torque()).
  bool has_torque = false;
  double max_torque_Nm = 0.0;
  /// Moment of inertia of the handle about any axis; NaN = unknown.
  double inertia_kg_m2 = std::numeric_limits<double>::quiet_NaN();
  double rotational_damping_Nm_s = std::numeric_limits<double>::quiet_NaN();
};

/// Errors: usage for a value that no device has: degrees of freedom other than 2 and 3, a force above 250 N,
/// a torque that is negative or, with has_torque, 0, a mass of 0 or above 100 kg, and the like. What may be
/// unknown may be NaN.
Result<void> check(const Traits& traits);

enum class Status : std::uint8_t {
  ok,
  /// Open but not homed or calibrated: no position-based force may be sent yet.
  not_ready,
  /// The last position is outdated: no new one arrived in time.
  stale,
  /// The device failed; fault() describes how.
  fault
};

/// The time of a recorded tick and its flags (haptics::flag). A device that replays a recording returns them
/// with the reading. The tick uses them instead of the clock, so that the same readings give the same forces.
struct RecordedTime {
  double t_s = 0.0;
  double dt_s = 0.001;
  std::uint32_t flags = 0;
};

/// A rotation matrix, row-major.
using Rotation = std::array<double, 9>;
inline constexpr Rotation kIdentityRotation{1, 0, 0, 0, 1, 0, 0, 0, 1};

struct Reading {
  Point<DeviceFrame> position;
  Status status = Status::ok;
  /// Bit k is set if button k is pressed.
  std::uint32_t buttons = 0;
  /// Orientation of the handle, device_from_tool; valid if Traits::has_torque.
  Rotation rotation = kIdentityRotation;
  std::optional<RecordedTime> recorded = std::nullopt;
  /// The hand moves the device without touching: as in a pause, no force is wanted.
  bool clutched = false;
  /// The device has given no new position since the last reading, so the position of that one is repeated: it
  /// does not say that the hand stands still.
  bool is_repeated = false;
};

/// A force-feedback device or a substitute. It is opened by open_device() and closed by its destructor, which
/// first writes zero force. One thread calls read() and write() once per tick, in that order. They never
/// allocate, lock or throw, and return within the device's I/O time.
class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  virtual const Traits& traits() const noexcept = 0;
  virtual Reading read() noexcept = 0;
  /// The factor 0 ... 1 by which start, pause and fault ramp this tick's forces; called before each write().
  /// For a device that adds forces of its own, which must end with those of the touch.
  virtual void note_ramp(double /*factor*/) noexcept {}
  /// Sets the force on the hand. The caller guarantees that it is finite and within the cap.
  virtual void write(Vector<DeviceFrame> force_N) noexcept = 0;
  /// Sets the torque on the hand about the handle's origin; it takes effect with the next write(). Called
  /// only if Traits::has_torque.
  virtual void write_torque(Vector<DeviceFrame> /*torque_Nm*/) noexcept {}
  /// Sets zero force immediately. May be called in any state and more than once.
  virtual void stop() noexcept = 0;
  /// Sets zero force immediately, for a watchdog: another thread calls it while the servo's thread may be in
  /// read() or write(), or hang there. It must not wait for that thread. The servo's next write() takes
  /// effect again. A driver whose stop() may not be called in this way overrides this function.
  virtual void cut_force() noexcept { stop(); }
  /// A description of the failure, after Status::fault. Not for the tick path.
  virtual std::string fault() const { return {}; }
  /// What the person does next so that a device that is not ready becomes so, as one sentence without a full
  /// stop; empty if nothing. Any thread; not for the tick path.
  virtual std::string guidance() const { return {}; }
};

}  // namespace palpable::device
