// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/device/motor_heat.hpp"
#include "palpable/device/simulated/hand_script.hpp"
#include "palpable/device/simulated/motor_file.hpp"
#include "palpable/device/zero_write.hpp"

#include <array>
#include <atomic>
#include <memory>

namespace palpable::device {

/// A device's moving mass, held by an arm. The arm's defaults are the example that van Beek, Bergmann Tiest,
/// Mugge & Kappers fitted to a measured arm (Scientific Reports 5:18004, 2015, figure 3): 0.554 kg, 6.45
/// N·s/m, 135 N/m. The device's defaults are those of a light three-axis desktop device. docs/devices.md
/// lists the ranges.
struct HandOptions {
  double device_mass_kg = 0.1;
  double device_damping_Ns_per_m = 0.1;
  double device_friction_N = 0.05;
  double arm_mass_kg = 0.554;
  double arm_damping_Ns_per_m = 6.45;
  double arm_stiffness_N_per_m = 135.0;
  /// Resolution of the position sensor; 0 = exact.
  double resolution_m = 10e-6;
  /// Time between two new positions of the sensor; 0 = one in each tick.
  double sensor_period_s = 0.0;
  /// Delay in ticks from writing a force until it acts at the motor, 0 ... 8.
  int delay_samples = 0;
  double max_force_N = 3.3;
  /// What the motors can hold for ever, N, 0.1 to 40; kNoForce_N: the greatest force.
  double continuous_force_N = kNoForce_N;
  double rate_hz = 1000.0;
  int degrees_of_freedom = 3;
  /// The handle rotates and takes torques. The hand holds it upright and tilts it slowly in both directions.
  bool has_torque = false;
  double max_torque_Nm = 0.2;
  double device_inertia_kg_m2 = 5e-5;
  double device_rotational_damping_Nm_s = 1e-4;
  double hand_inertia_kg_m2 = 1e-4;
  double hand_rotational_damping_Nm_s = 0.01;
  double hand_rotational_stiffness_Nm = 1.0;
  /// Amplitude and frequency of the tilt.
  double tilt_rad = 0.3;
  double tilt_hz = 0.4;
  /// The hand presses this button, counted from 1; 0 = none. In simulated time: from `press_at_s` on for
  /// `press_for_s`, and again every `press_every_s` if that is above 0.
  int button = 0;
  double press_at_s = 1.0;
  double press_for_s = 1.0;
  double press_every_s = 0.0;
  HandScriptOptions script;
};

/// Simulates a hand on a device in time steps of a tenth of a tick. Each write() advances the simulated time
/// by one period of rate_hz, independently of the clock, so that the same forces give the same movements,
/// live or in a test. Semi-implicit Euler steps with exact stiction: friction can hold the mass at rest.
class SimulatedHand final : public Device, public Guardable {
 public:
  static constexpr int kMostDelay = 8;

  /// `motors`: receives the motor force too; may be null.
  explicit SimulatedHand(const HandOptions& options, std::unique_ptr<MotorFile> motors = nullptr);

  const Traits& traits() const noexcept override { return traits_; }
  Reading read() noexcept override;
  void write(Vector<DeviceFrame> force_N) noexcept override;
  void write_torque(Vector<DeviceFrame> torque_Nm) noexcept override { torque_Nm_ = torque_Nm.v; }
  void stop() noexcept override;
  void cut_force() noexcept override;
  std::optional<ZeroWrite> zero_write() const override;

  /// The desired position, for the script `hold`.
  void set_goal(Vec3 goal_m) noexcept { script_.set_goal(goal_m); }
  /// The exact position and velocity, without the sensor's quantisation; and a function that places the hand,
  /// at rest.
  Vec3 true_position_m() const noexcept { return position_m_; }
  Vec3 true_velocity_m_per_s() const noexcept { return velocity_m_per_s_; }
  void place(Vec3 position_m) noexcept;

 private:
  std::uint32_t pressed() const noexcept;
  void turn(Vec3 motor_Nm, double dt_s) noexcept;
  void move(Vec3 motor_N, Vec3 goal_m, Vec3 goal_velocity_m_per_s, double dt_s) noexcept;
  /// The sensor takes a new position once its period has passed.
  void sense(double dt_s) noexcept;

  HandOptions options_;
  std::unique_ptr<MotorFile> motors_;
  Traits traits_;
  HandScript script_;
  Vec3 position_m_;
  Vec3 velocity_m_per_s_;
  /// The sensor's last position, the time since then, and whether it was read before.
  Vec3 sensed_m_;
  double unsensed_s_ = 0.0;
  bool is_repeated_ = false;
  Vec3 goal_m_;
  /// Ring buffer of delayed forces; the next one to act is at delayed_.
  std::array<Vec3, kMostDelay + 1> on_the_way_N_{};
  std::array<Vec3, kMostDelay + 1> on_the_way_Nm_{};
  /// The torque of the next write().
  Vec3 torque_Nm_;
  Rotation rotation_ = kIdentityRotation;
  Vec3 angular_velocity_rad_per_s_;
  double turning_s_ = 0.0;
  double passed_s_ = 0.0;
  std::size_t delayed_ = 0;
  /// The motors were cut: delayed forces are dropped.
  std::atomic<bool> cut_{false};
};

class DeviceUrl;
struct OpenOptions;

/// Opens `sim:` with the options of docs/devices.md. Errors (usage): an option out of range.
Result<std::unique_ptr<Device>> open_simulated_hand(DeviceUrl& url, const OpenOptions& options);

}  // namespace palpable::device
