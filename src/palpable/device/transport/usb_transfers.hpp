// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace palpable::device {

/// The transfers of a USB device with an FTDI serial chip: its control requests, and packets both ways. One
/// thread at a time. The clock is that of the transport, so that a virtual device can run in simulated time.
class UsbTransfers {
 public:
  /// Every packet that arrives begins with two bytes of modem status.
  static constexpr std::size_t kStatus_bytes = 2;
  using Packet = std::array<std::byte, 64>;

  UsbTransfers() = default;
  UsbTransfers(const UsbTransfers&) = delete;
  UsbTransfers& operator=(const UsbTransfers&) = delete;
  virtual ~UsbTransfers() = default;

  /// A request of the vendor's type 0x40 with index 0; waits for it. False if it was refused.
  virtual bool control(std::uint8_t request, std::uint16_t value) noexcept = 0;
  /// Begins to send at most 64 bytes. False if the last ones are still on their way, or the device is lost.
  virtual bool send(std::span<const std::byte> bytes) noexcept = 0;
  /// Waits for the next packet, at most this long, and returns the number of its bytes; 0 if none came.
  virtual std::size_t receive(Packet& packet, double longest_s) noexcept = 0;
  /// Seconds since some moment.
  virtual double now_s() const noexcept = 0;
  /// It was unplugged, or the system reports errors.
  virtual bool lost() const noexcept = 0;
};

}  // namespace palpable::device
