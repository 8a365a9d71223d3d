// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/hand_off.hpp"
#include "palpable/device/device.hpp"
#include "palpable/device/motor_heat.hpp"
#include "palpable/device/open_haptics/hd_functions.hpp"
#include "palpable/device/transport/force_hand_off.hpp"
#include "palpable/device/transport/fresh_reading.hpp"
#include "palpable/device/transport/library_call.hpp"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace palpable::device {

class DeviceUrl;
struct OpenOptions;

struct OpenHapticsOptions {
  /// The name that the vendor's set-up program gave the device; empty: its default device.
  std::string name;
  /// Greatest force, N, 0.1 to 40; 0: the device's own limit as the library states it.
  double max_force_N = 0.0;
  /// What the motors can hold for ever, N, 0.1 to 40; kNoForce_N: the device's own as the library states it,
  /// else an assumption.
  double continuous_force_N = kNoForce_N;
  /// Rate of the servo, Hz.
  double rate_hz = 1000.0;
};

/// A device that 3D Systems' libHD drives (docs/devices.md): three axes, forces only. The library's own
/// thread calls the driver about 1000 times per second. There the position is read and the newest force
/// written; the servo's thread exchanges both with it without waiting (ForceHandOff).
class OpenHaptics final : public Device, public CallsByThread {
 public:
  /// Starts the library's thread. Errors (device): no device, or the library's own sentence.
  static Result<std::unique_ptr<OpenHaptics>> open(const HdFunctions& hd, const OpenHapticsOptions& options);
  ~OpenHaptics() override;

  const Traits& traits() const noexcept override { return traits_; }
  Reading read() noexcept override;
  void write(Vector<DeviceFrame> force_N) noexcept override;
  void stop() noexcept override;
  std::string fault() const override;
  std::string guidance() const override;
  std::int64_t in_call_since_ns() const noexcept override {
    return in_call_since_ns_.load(std::memory_order_acquire);
  }

 private:
  /// From the library's thread to the servo's.
  struct State {
    Vec3 position_mm;
    std::uint32_t buttons = 0;
    bool calibrated = false;
  };
  OpenHaptics(const HdFunctions& hd, unsigned handle, const OpenHapticsOptions& options);
  static unsigned on_call(void* self);
  void exchange() noexcept;
  bool is_calibrated() noexcept;
  /// Whether the loop goes on; keeps what the library says.
  bool note_error(unsigned code) noexcept;

  HdFunctions hd_;
  std::atomic<std::int64_t> in_call_since_ns_{0};
  unsigned handle_;
  unsigned long task_ = 0;
  Traits traits_;
  Vec3 centre_mm_;

  LatestValue<State> states_;
  ForceHandOff forces_;
  /// The last error that stopped the loop, 0 for none.
  std::atomic<unsigned> error_{0};

  // The library's thread writes them.
  std::atomic<bool> calibrated_{false};
  /// The last error of the forces (hd::kFirstForceError …), 0 when none has come for a while.
  std::atomic<unsigned> force_error_{0};
  // The library's thread only.
  int until_calibration_check_ = 0;
  int since_force_error_ = 0;

  // The servo's thread only.
  State state_;
  FreshReading fresh_;
};

/// Opens `touch:NAME?max-force=N&library=FILE`; without a name the default device. Errors: usage (options),
/// device.
Result<std::unique_ptr<Device>> open_open_haptics(DeviceUrl& url, const OpenOptions& options);

/// One entry without a name: libHD cannot list its devices. Errors (device): the library is not installed.
Result<std::vector<std::string>> open_haptics_ports();

}  // namespace palpable::device
