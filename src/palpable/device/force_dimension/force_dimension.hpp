// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/device/force_dimension/dhd_functions.hpp"
#include "palpable/device/motor_heat.hpp"
#include "palpable/device/transport/fresh_reading.hpp"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace palpable::device {

class DeviceUrl;
struct OpenOptions;

struct ForceDimensionOptions {
  /// The device's number, from 0.
  int index = 0;
  /// Moves the handle by its motors at the start until its position is known exactly, if the library can.
  bool initialise = true;
  /// Greatest force, N, 0.1 to 40; 0: the device's own limit as the library states it, else kUnknownForce_N.
  double max_force_N = 0.0;
  /// What the motors can hold for ever, N, 0.1 to 40; kNoForce_N: the greatest force, which its maker states
  /// as a continuous one.
  double continuous_force_N = kNoForce_N;
  /// Rate of the servo, Hz.
  double rate_hz = 1000.0;
};

/// A device that Force Dimension's library drives (docs/devices.md): three axes, forces only. Positions are
/// read and forces written by calls of the library in the servo's thread, which wait for the USB transfer.
class ForceDimension final : public Device {
 public:
  /// The force limit of a device for which the library states none.
  static constexpr double kUnknownForce_N = 8.0;

  /// Errors (device): no device, or the library's own sentence.
  static Result<std::unique_ptr<ForceDimension>> open(const DhdFunctions& dhd,
                                                      const ForceDimensionOptions& options);
  ~ForceDimension() override;

  const Traits& traits() const noexcept override { return traits_; }
  Reading read() noexcept override;
  void write(Vector<DeviceFrame> force_N) noexcept override;
  void stop() noexcept override;
  std::string fault() const override;

 private:
  ForceDimension(const DhdFunctions& dhd, char number, const ForceDimensionOptions& options);

  DhdFunctions dhd_;
  char number_;
  Traits traits_;
  FreshReading fresh_;
  /// For how long it has refused forces.
  std::atomic<double> refused_s_{0.0};
  /// No position has come.
  std::atomic<bool> is_silent_{false};
};

/// Opens `forcedimension:INDEX?initialise=yes&max-force=N&library=FILE`; without an index the first device.
/// Errors: usage (options), device.
Result<std::unique_ptr<Device>> open_force_dimension(DeviceUrl& url, const OpenOptions& options);

/// The devices that are plugged in, by their numbers: "0", "1". Errors (device): the library is not
/// installed.
Result<std::vector<std::string>> force_dimension_ports();

}  // namespace palpable::device
