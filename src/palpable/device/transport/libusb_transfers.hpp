// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/transport/usb_transfers.hpp"

#include <memory>

namespace palpable::device {

/// A vendor's and a product's number.
struct UsbIds {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
};

/// UsbTransfers by libusb, asynchronous: two transfers from the device always wait, so that no packet is
/// late. Of an FTDI chip's first interface.
class LibusbTransfers final : public UsbTransfers {
 public:
  /// The endpoint to the device.
  static constexpr std::uint8_t kOut = 0x02;

  /// Opens the device of this number, from 0. Errors (device): not there, no permission, used by another
  /// program.
  static Result<std::unique_ptr<LibusbTransfers>> open(UsbIds ids, int index);
  ~LibusbTransfers() override;

  bool control(std::uint8_t request, std::uint16_t value) noexcept override;
  bool send(std::span<const std::byte> bytes) noexcept override;
  std::size_t receive(Packet& packet, double longest_s) noexcept override;
  double now_s() const noexcept override;
  bool lost() const noexcept override;
  /// The system's descriptor of the device.
  int descriptor() const noexcept;

 private:
  struct Usb;
  explicit LibusbTransfers(std::unique_ptr<Usb> usb);
  std::unique_ptr<Usb> usb_;
};

/// How many of these devices are plugged in; 0 also where there is no USB. Errors (device): one is, but this
/// user may not open it.
Result<int> count_usb_devices(UsbIds ids);

}  // namespace palpable::device
