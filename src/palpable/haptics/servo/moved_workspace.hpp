// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/device/zero_write.hpp"
#include "palpable/haptics/safety/passivity.hpp"
#include "palpable/haptics/tick/tick_options.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace palpable::haptics {

/// What happens to a hand at the border of its device's workspace, and how it reaches places beyond it.
struct WorkspaceOptions {
  /// A soft spring and damper at the border.
  bool cushion = true;
  /// How much larger the scene is than what fits into the workspace, 1 ... 10. Above 1 the scene moves
  /// beneath a hand that is near the border, faster the nearer it is to it.
  double magnification = 1.0;
  /// While this button is pressed the scene moves with the hand, without force; nullopt = none.
  std::optional<int> clutch_button;
  /// Pressing this button ends the force as a pause does, until it is pressed again; nullopt = none.
  std::optional<int> stop_button;
  /// Greatest speed of the scene beneath a hand at the border, metres per second at the device.
  double drive_speed_m_per_s = 0.03;
};

/// What a hand's workspace keeps when its device is opened again. Any thread.
struct WorkspaceState {
  /// The stop button has ended the force.
  std::atomic<bool> stopped{false};
  /// How far the scene reaches from the middle of the device's workspace on each axis, m, at the device. The
  /// border moves it no farther than so that its end, and some air beyond, can be reached.
  std::array<std::atomic<double>, 3> scene_m{kUnknown_m, kUnknown_m, kUnknown_m};
  /// What is added to the positions of the device that is open, m.
  std::array<std::atomic<double>, 3> offset_m{0.0, 0.0, 0.0};

 private:
  static constexpr double kUnknown_m = std::numeric_limits<double>::infinity();
};

/// Errors (usage): a magnification or button out of range.
Result<void> check(const WorkspaceOptions& options);

/// A device whose workspace can be moved: it adds an offset to the positions of another device, and the
/// border's cushion to its forces. Positions never jump: the offset moves with a bounded speed at the border,
/// and against the hand while it is clutched (Reading::clutched).
///
/// The cushion is a spring whose potential is known, with a damper; both grow from zero behind the edge, and
/// a PassivityObserver of its own reduces them. A hand that begins beyond the edge feels no spring before it
/// has moved inward. What the moving scene may give to the hand is limited by an account: it holds at most
/// kReserve_J, is filled by the energy that the hand gives and by kRefill_W, and pays for what the hand gets.
/// The movement slows down where less than half is left, and stops where nothing is, or where the force of
/// the touch opposes it.
///
/// Its traits are those of the device. Threads as for every device; one servo calls it.
class MovedWorkspace final : public device::Device, public device::Guardable {
 public:
  static constexpr double kReserve_J = 0.02;
  static constexpr double kRefill_W = 0.002;
  /// The border zone, as a part of the workspace's width on each side. It lies inside of the workspace where
  /// the scene moves there, else outside of it: then nothing inside changes.
  static constexpr double kZone = 0.1;

  /// `device` must not be null and have motors; `rate_hz` > 0 is the servo's rate. `state` may be null, if no
  /// device is opened after this one.
  MovedWorkspace(std::unique_ptr<device::Device> device, const WorkspaceOptions& options, double rate_hz,
                 std::shared_ptr<WorkspaceState> state = nullptr);

  const device::Traits& traits() const noexcept override { return device_->traits(); }
  device::Reading read() noexcept override;
  void note_ramp(double factor) noexcept override { ramp_ = factor; }
  void write(Vector<DeviceFrame> force_N) noexcept override;
  void write_torque(Vector<DeviceFrame> torque_Nm) noexcept override { device_->write_torque(torque_Nm); }
  void stop() noexcept override { device_->stop(); }
  void cut_force() noexcept override { device_->cut_force(); }
  std::string fault() const override { return device_->fault(); }
  std::string guidance() const override { return device_->guidance(); }
  std::optional<device::ZeroWrite> zero_write() const override;

  /// What is added to the device's positions, m; the cushion's newest force; and the greatest energy that it
  /// made beyond its damper's reserve. Of the thread that reads and writes.
  Vec3 offset_m() const noexcept { return offset_m_; }
  Vector<DeviceFrame> cushion_N() const noexcept { return cushion_N_; }
  double cushion_made_max_J() const noexcept { return observer_.made_max_J(); }
  /// What is left of the account, J.
  double reserve_J() const noexcept { return reserve_J_; }

 private:
  /// The border of one axis.
  struct Axis {
    double half_m = 0.0;
    double zone_m = 0.0;
    /// Greatest offset.
    double reach_m = 0.0;
  };
  struct Cushion {
    Vec3 force_N;
    double stored_J = 0.0;
    double damping_Ns_per_m = 0.0;
    bool contact = false;
  };
  void forget() noexcept;
  void drive(Vec3 position_m) noexcept;
  /// How far the border moves the scene on this axis.
  double driven_reach_m(std::size_t axis) const noexcept;
  void move_with_hand(Vec3 moved_m) noexcept;
  /// Follows the stop button; whether the force is off by it.
  bool is_stopped(std::uint32_t buttons) noexcept;
  void tell_offset() noexcept;
  Cushion cushion_at(Vec3 position_m, Vec3 velocity_m_per_s) noexcept;
  void cushion(Vec3 position_m, Vec3 moved_m) noexcept;

  std::unique_ptr<device::Device> device_;
  WorkspaceOptions options_;
  double period_s_;
  double max_rise_N_;
  std::array<Axis, 3> axes_{};
  double stiffness_N_per_m_ = 0.0;
  double damping_Ns_per_m_ = 0.0;
  double max_cushion_N_ = 0.0;

  Vec3 offset_m_;
  /// Of the scene beneath the hand.
  Vec3 speed_m_per_s_;
  std::optional<Vec3> position_m_;
  std::shared_ptr<WorkspaceState> state_;
  bool was_stop_pressed_ = false;
  /// How far beyond the edge the spring begins.
  Vec3 slack_m_;
  double ramp_ = 0.0;
  double reserve_J_ = kReserve_J;
  PassivityObserver observer_;
  Vector<DeviceFrame> cushion_N_;
  Vector<DeviceFrame> touch_N_;
  /// Forces on their way to the motors, the newest at newest_.
  struct Sent {
    Vector<DeviceFrame> total_N;
    Vector<DeviceFrame> cushion_N;
  };
  static constexpr std::size_t kMostDelay = 15;
  std::array<Sent, kMostDelay + 1> sent_{};
  std::size_t newest_ = 0;
  std::size_t delay_ = 0;
};

}  // namespace palpable::haptics
