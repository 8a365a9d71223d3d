// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/hand_off.hpp"
#include "palpable/device/device.hpp"
#include "palpable/device/local_surface.hpp"
#include "palpable/device/local_textures.hpp"
#include "palpable/device/remote/remote_wire.hpp"
#include "palpable/device/transport/force_hand_off.hpp"
#include "palpable/device/transport/fresh_reading.hpp"

#include <atomic>
#include <memory>
#include <string>

namespace palpable::device {

class DeviceUrl;
struct OpenOptions;
class RemoteLink;

/// What the servo's thread and the thread of the connection exchange, without waiting.
struct RemoteExchange {
  /// A surface that the servo wrote longer ago than this is not sent any more.
  static constexpr double kUnwritten_s = 0.1;
  LatestValue<RemoteReading> readings;
  CommandHandOff<LocalSurface> surfaces{kUnwritten_s};
  LocalTextures textures;
  /// The session has ended: no connection will come again.
  std::atomic<bool> failed{false};
};

/// A device at another computer, where `palpable share` serves it (docs/devices.md). Forces are never sent:
/// in each tick the surface near the hand is, and the other computer's own loop computes its forces at its
/// own rate. So what is written here only says what this computer would have made. Safety is the other
/// side's: its limits, its watchdog, and zero force when surfaces come no more.
class RemoteDevice final : public Device, public TakesLocalSurface {
 public:
  /// Positions that are older than this make the touch stale; after kSilent_s it has failed. A broken
  /// connection is made again meanwhile and later.
  static constexpr double kStale_s = 0.1;
  static constexpr double kSilent_s = 2.0;

  /// `link` may be null, if something else serves the exchange.
  RemoteDevice(Traits traits, std::shared_ptr<RemoteExchange> exchange, double rate_hz,
               std::shared_ptr<RemoteLink> link);
  ~RemoteDevice() override;

  const Traits& traits() const noexcept override { return traits_; }
  /// Late positions come several at a time. The position that is returned follows the newest with at most
  /// kCatchUp_m_per_s, so that a proxy can follow on the surface.
  Reading read() noexcept override;
  void write_surface(const LocalSurface& surface) noexcept override;
  std::shared_ptr<LocalTextures> textures() noexcept override { return {exchange_, &exchange_->textures}; }
  void write(Vector<DeviceFrame> /*force_N*/) noexcept override {}
  void stop() noexcept override { exchange_->surfaces.cut(); }
  /// Nothing: a surface is passive and is not used for longer than a tenth of a second; the watchdog at the
  /// device's own loop cuts its force.
  void cut_force() noexcept override {}
  std::string fault() const override;

 private:
  static constexpr double kCatchUp_m_per_s = 2.0;

  Traits traits_;
  std::shared_ptr<RemoteExchange> exchange_;
  double period_s_;
  FreshReading fresh_;
  RemoteReading newest_;
  Vec3 followed_m_;
  bool follows_ = false;
  std::shared_ptr<RemoteLink> link_;
};

/// Checks that a URL has the form of an address that `palpable share` prints, without connecting. Errors:
/// usage.
Result<void> check_remote(DeviceUrl& url);

/// Opens `remote:HOST:PORT?token=...`, the address that `palpable share` prints. Errors: usage (no such
/// address), device (nobody shares there, refused).
Result<std::unique_ptr<Device>> open_remote(DeviceUrl& url, const OpenOptions& options);

}  // namespace palpable::device
