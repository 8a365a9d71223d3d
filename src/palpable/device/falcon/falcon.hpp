// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/device/falcon/falcon_link.hpp"
#include "palpable/device/motor_heat.hpp"
#include "palpable/device/transport/fresh_reading.hpp"
#include "palpable/device/zero_write.hpp"

#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace palpable::device {

class DeviceUrl;
struct OpenOptions;

struct FalconOptions {
  /// The file of the vendor's firmware; needed once after the device was plugged in.
  std::string firmware;
  /// Greatest force, N, 0.1 to 40; never above what the motors can hold everywhere in the workspace.
  double max_force_N = 40.0;
  /// What the motors can hold for ever, N, 0.1 to 40; kNoForce_N: an assumption (continuous_force()).
  double continuous_force_N = kNoForce_N;
  /// Rate of the servo, Hz.
  double rate_hz = 1000.0;
  /// Else read() exchanges the packets of the past period in the servo's thread: for tests in simulated time.
  bool own_thread = true;
};

/// The Novint Falcon (docs/devices.md): three axes, forces only, four buttons. A thread of the driver sends
/// one command for each reply (FalconLink); the servo's thread exchanges forces and places with it without
/// waiting. Until its arms are homed it is not ready and gets no force: guidance() says how.
class Falcon final : public Device, public Guardable {
 public:
  /// Loads the firmware if it does not run yet. `descriptor`: of the USB device, for the guardian; -1: none.
  /// Errors (device): no firmware (which the error says), and those of load_falcon_firmware().
  static Result<std::unique_ptr<Falcon>> open(std::unique_ptr<UsbTransfers> usb, const FalconOptions& options,
                                              int descriptor = -1);
  ~Falcon() override;

  const Traits& traits() const noexcept override { return traits_; }
  Reading read() noexcept override;
  void write(Vector<DeviceFrame> force_N) noexcept override;
  void stop() noexcept override;
  std::string fault() const override;
  std::string guidance() const override;
  std::optional<ZeroWrite> zero_write() const override;

 private:
  Falcon(std::unique_ptr<UsbTransfers> usb, const FalconOptions& options, int descriptor);
  void exchange_a_period() noexcept;

  std::unique_ptr<UsbTransfers> usb_;
  FalconLink link_;
  int descriptor_;
  Traits traits_;
  FreshReading fresh_;
  /// The end of the period, in the transport's time; only without a thread of its own.
  double until_s_ = 0.0;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

/// Opens `falcon:INDEX?firmware=FILE&max-force=N`; without an index the only Falcon that is plugged in.
/// Errors: usage (options), device.
Result<std::unique_ptr<Device>> open_falcon(DeviceUrl& url, const OpenOptions& options);

/// The Falcons that are plugged in, by their numbers: "0". Errors (device): one is, but it may not be used.
Result<std::vector<std::string>> falcon_ports();

}  // namespace palpable::device
