// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/hand_off.hpp"
#include "palpable/device/device.hpp"
#include "palpable/device/local_surface.hpp"
#include "palpable/device/remote/remote_wire.hpp"
#include "palpable/device/zero_write.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace palpable::device {

/// What the servo of a shared device and the thread of its connection exchange, without waiting.
struct SharedExchange {
  LatestValue<LocalSurface> surfaces;
  LatestValue<RemoteReading> readings;
  /// A client is connected.
  std::atomic<bool> connected{false};
  /// Counts the clients that came with a new token: each has an account of its own.
  std::atomic<std::uint32_t> sessions{0};
  /// Of the newest surface that makes forces.
  std::atomic<LocalSurface::Kind> kind{LocalSurface::Kind::plane};
};

/// A device that another computer touches with: it reports what it reads, and keeps the newest surface that
/// came for the law of this computer's loop. It is stale, so that the loop ramps its force to zero, when no
/// surface has come for kSilent_s, when the newest is of a reading that is older than kOldest_s, or when it
/// wants no force; not ready without a client. It counts the work of the device's force on the hand
/// (CurrentSurface::account), also while surfaces are too old. Everything else is the device's own.
class SharedDevice final : public Device, public Guardable {
 public:
  static constexpr double kSilent_s = 0.1;
  static constexpr double kOldest_s = 0.3;

  /// `current` receives the surface of each tick, for the law. `now_s`: this computer's clock, seconds, >= 0;
  /// called in each tick.
  SharedDevice(std::unique_ptr<Device> device, std::shared_ptr<SharedExchange> exchange,
               std::shared_ptr<CurrentSurface> current, std::function<double()> now_s);

  const Traits& traits() const noexcept override { return device_->traits(); }
  Reading read() noexcept override;
  void write(Vector<DeviceFrame> force_N) noexcept override;
  void write_torque(Vector<DeviceFrame> torque_Nm) noexcept override { device_->write_torque(torque_Nm); }
  void stop() noexcept override { device_->stop(); }
  void cut_force() noexcept override { device_->cut_force(); }
  std::string fault() const override { return device_->fault(); }
  std::string guidance() const override { return device_->guidance(); }
  std::optional<ZeroWrite> zero_write() const override;

 private:
  /// Takes the newest surface; whether it may be used now.
  bool take_surface(double now_s) noexcept;
  void count_work(const Reading& reading, double now_s) noexcept;

  std::unique_ptr<Device> device_;
  std::shared_ptr<SharedExchange> exchange_;
  std::shared_ptr<CurrentSurface> current_;
  std::function<double()> now_s_;
  bool has_surface_ = false;
  double came_at_s_ = 0.0;
  std::uint32_t session_ = 0;
  /// Where the device was read last; nullopt after a fault.
  std::optional<Vec3> place_m_;
  /// Forces on their way to the motors, the newest at newest_.
  static constexpr std::size_t kMostDelay = 15;
  std::array<Vec3, kMostDelay + 1> sent_N_{};
  std::size_t newest_ = 0;
  std::size_t delay_ = 0;
};

/// The clock of a shared device: seconds since this program began.
double shared_clock_s();

}  // namespace palpable::device
