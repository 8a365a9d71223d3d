// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/device/inverse3/inverse3_messages.hpp"
#include "palpable/device/motor_heat.hpp"
#include "palpable/device/transport/fresh_reading.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace palpable::device {

class DeviceUrl;
struct OpenOptions;

struct Inverse3Options {
  /// Identifier of the device; empty: the first that the service lists.
  std::string device_id;
  std::uint16_t port = 10001;
  /// N, 0.1 to 40.
  double max_force_N = 8.0;
  /// What the motors can hold for ever, N, 0.1 to 40; kNoForce_N: an assumption (continuous_force()).
  double continuous_force_N = kNoForce_N;
  Inverse3Form form = Inverse3Form::both;
  /// Rate of the servo, Hz.
  double rate_hz = 1000.0;
};

/// The Haply Inverse3 behind its maker's service (docs/devices.md): three axes, forces only. The middle of
/// the workspace is where the handle is when the device is opened. A thread of the driver sends a force for
/// each answer of the service, so the rate is that of the answers; the servo's thread exchanges both with it
/// without waiting.
class Inverse3 final : public Device {
 public:
  /// Errors (device): no service, none of its devices has the identifier, no answer within two seconds.
  static Result<std::unique_ptr<Inverse3>> open(const Inverse3Options& options);
  ~Inverse3() override;

  const Traits& traits() const noexcept override { return traits_; }
  Reading read() noexcept override;
  void write(Vector<DeviceFrame> force_N) noexcept override;
  void stop() noexcept override;
  std::string fault() const override;
  std::string guidance() const override;

 private:
  class Link;
  Inverse3(std::unique_ptr<Link> link, const Inverse3Options& options);

  std::unique_ptr<Link> link_;
  Traits traits_;
  FreshReading fresh_;
  Vec3 centre_m_;
};

/// Opens `inverse3:DEVICE?port=10001&max-force=8&form=both`; without an identifier the first device. Errors:
/// usage (options), device.
Result<std::unique_ptr<Device>> open_inverse3(DeviceUrl& url, const OpenOptions& options);

/// The service's device, without an identifier. Errors (device): no service listens on the usual port.
Result<std::vector<std::string>> inverse3_ports();

}  // namespace palpable::device
