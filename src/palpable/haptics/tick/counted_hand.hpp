// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// A simulated hand that counts what it receives, for tests of energy.

#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/haptics/tick/rotation.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace palpable::haptics {

/// A simulated hand, and the energy that it received from its motors by its true movements since it was last
/// in free air.
class CountedHand final : public device::Device {
 public:
  explicit CountedHand(const device::HandOptions& options)
      : hand_(options), on_the_way_(static_cast<std::size_t>(options.delay_samples)) {}

  const device::Traits& traits() const noexcept override { return hand_.traits(); }
  device::Reading read() noexcept override { return hand_.read(); }
  void write_torque(Vector<DeviceFrame> torque_Nm) noexcept override { written_Nm_ = torque_Nm; }
  void write(Vector<DeviceFrame> force_N) noexcept override {
    written_N_ = force_N;
    on_the_way_.push_back({force_N, written_Nm_});
    const Motors acts = on_the_way_.front();
    on_the_way_.erase(on_the_way_.begin());
    const Vec3 before_m = hand_.true_position_m();
    const device::Rotation before = hand_.read().rotation;
    hand_.write_torque(written_Nm_);
    hand_.write(force_N);
    const double work_J = dot(acts.force_N.v, hand_.true_position_m() - before_m) +
                          dot(acts.torque_Nm, rotation_between(before, hand_.read().rotation));
    received_J_ += work_J;
    total_J_ += work_J;
    most_J_ = std::max(most_J_, received_J_);
  }
  void stop() noexcept override { hand_.stop(); }

  /// As SimulatedHand's.
  void set_goal(Vec3 goal_m) noexcept { hand_.set_goal(goal_m); }
  void place(Vec3 position_m) noexcept { hand_.place(position_m); }
  Vec3 true_position_m() const noexcept { return hand_.true_position_m(); }

  /// No tick comes for so long; after 5 ms the watchdog cuts the force.
  void stall(int ticks) {
    for (int n = 1; n < ticks; ++n) {
      if (n == 5) cut();
      write(written_N_);
    }
  }
  /// The watchdog ends the force.
  void cut() {
    hand_.cut_force();
    written_N_ = written_Nm_ = {};
    std::fill(on_the_way_.begin(), on_the_way_.end(), Motors{});
  }
  /// To be called in free air. A new account begins once no force is on its way to the motors any more: a
  /// force that acts late belongs to the contact that it comes from.
  void in_free_air() noexcept {
    const auto nothing = [](const Motors& motors) { return motors.force_N == Vector<DeviceFrame>{}; };
    if (written_N_ == Vector<DeviceFrame>{} && std::ranges::all_of(on_the_way_, nothing)) received_J_ = 0.0;
  }
  double received_J() const noexcept { return received_J_; }
  /// Since the beginning.
  double total_J() const noexcept { return total_J_; }
  /// The most that was received in any contact: positive if more than the hand had given in it.
  double most_J() const noexcept { return most_J_; }
  Vector<DeviceFrame> written_N() const noexcept { return written_N_; }

 private:
  struct Motors {
    Vector<DeviceFrame> force_N;
    Vector<DeviceFrame> torque_Nm;
  };
  device::SimulatedHand hand_;
  std::vector<Motors> on_the_way_;
  Vector<DeviceFrame> written_N_;
  Vector<DeviceFrame> written_Nm_;
  double received_J_ = 0.0;
  double total_J_ = 0.0;
  double most_J_ = 0.0;
};

}  // namespace palpable::haptics
