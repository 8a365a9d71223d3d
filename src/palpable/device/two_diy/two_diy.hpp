// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/device/motor_heat.hpp"
#include "palpable/device/transport/fresh_reading.hpp"
#include "palpable/device/transport/port_state.hpp"
#include "palpable/device/transport/serial_port.hpp"
#include "palpable/device/two_diy/two_diy_wire.hpp"
#include "palpable/device/zero_write.hpp"

#include <chrono>
#include <memory>
#include <string>

namespace palpable::device {

class DeviceUrl;
struct OpenOptions;

/// The Haply 2DIY (docs/devices.md). The handle lies in the plane z = 0; x points to the right and y away
/// from the user, from the middle of the workspace. The board holds the last torque until it gets another, so
/// zero is sent on every way out, and by the guardian after a kill.
///
/// Each message with torques is answered by the angles. write() sends the next torques when the last ones
/// were answered, or after kPatience_s; zero after another torque is sent at once. stop() and cut_force() may
/// be called by any thread at any time.
class TwoDiy final : public Device, public Guardable {
 public:
  /// Without a new answer for this long, the torques are sent again.
  static constexpr double kPatience_s = 0.005;

  /// Sets the board up: the handle must be at home. Errors (device): several answers in a row are not those
  /// of a board near its home, or other bytes come.
  static Result<std::unique_ptr<TwoDiy>> open(const std::string& path, const TwoDiyVariant& variant,
                                              double rate_hz, double continuous_force_N = kNoForce_N);
  ~TwoDiy() override;

  const Traits& traits() const noexcept override { return traits_; }
  Reading read() noexcept override;
  void write(Vector<DeviceFrame> force_N) noexcept override;
  void stop() noexcept override;
  std::string fault() const override;
  std::optional<ZeroWrite> zero_write() const override;

 private:
  TwoDiy(std::unique_ptr<SerialPort> port, const TwoDiyVariant& variant, const Traits& traits);
  /// Takes the first answer. False if it is not near the angles at home, or no handle has its angles.
  bool begin(std::array<float, 2> first_deg) noexcept;
  /// Takes one of the next. False if it cannot follow the last one.
  bool goes_on(std::array<float, 2> board_deg) noexcept;
  /// Whether the board's first angle and torque belong to the second motor.
  bool is_swapped() const noexcept { return !ordered_by_motor_ && variant_.joints[0].port != 1; }
  bool is_plausible(std::array<float, 2> board_deg) const noexcept;
  void follow(std::array<float, 2> board_deg) noexcept;
  std::array<float, 2> in_board_order(std::array<double, 2> by_motor_Nm) const noexcept;

  std::unique_ptr<SerialPort> port_;
  const TwoDiyVariant& variant_;
  Traits traits_;
  TwoDiyAnswers answers_;
  double period_s_;
  /// Of answers; without recent ones the torques are zero.
  FreshReading fresh_;
  std::array<float, 2> board_deg_{};
  LinkAngles angles_{};
  /// The board numbers its angles and torques by motor, not by port.
  bool ordered_by_motor_ = false;
  /// Whether the last angles determine a place.
  bool has_place_ = false;
  /// Messages that were sent and not yet answered, and answers at the last count.
  std::uint64_t awaited_ = 0;
  std::uint64_t answered_ = 0;
  bool sent_zero_ = true;
  double since_sent_s_ = 0.0;
  /// Of the last read(): late ticks are not counted as short ones.
  std::chrono::steady_clock::time_point read_at_ = std::chrono::steady_clock::now();
};

/// Opens `2diy:PATH?variant=v3`; without a path the only /dev/ttyACM* that is there. Errors: usage (options),
/// device.
Result<std::unique_ptr<Device>> open_two_diy(DeviceUrl& url, const OpenOptions& options);

/// The ports on which a 2DIY may be, sorted: /dev/ttyACM*.
std::vector<std::string> two_diy_ports();

/// Whether a port's USB device says that it is of the 2DIY's maker. Others may be a 2DIY, since its boards
/// also show the numbers of the board that they were made from.
bool is_surely_two_diy(const UsbIdentity& identity);

}  // namespace palpable::device
