// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/falcon/falcon_firmware.hpp"

#include "palpable/device/falcon/falcon_wire.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <span>
#include <system_error>

namespace palpable::device {
namespace {

// FTDI's control requests, and their values.
constexpr std::uint8_t kFtdiReset = 0, kModem = 1, kFlow = 2, kBaud = 3, kFormat = 4, kLatency = 9;
constexpr std::uint16_t kPurgeIn = 1, kPurgeOut = 2;
constexpr std::uint16_t kRtsLow = 0x0200, kDtrLow = 0x0100, kDtrHigh = 0x0101;
constexpr std::uint16_t kEightBits = 8, kNoFlow = 0;
constexpr std::uint16_t kPacketBaud = 0x0002, kGreetingBaud = 0x4138, kImageBaud = 0x0015;

constexpr double kWait_s = 0.1;
constexpr double kBlockWait_s = 0.5;
constexpr int kTries = 3;
constexpr std::size_t kBlock_bytes = 62;
constexpr std::uintmax_t kLargest_bytes = 1U << 20U;

bool purge(UsbTransfers& usb) noexcept {
  return usb.control(kFtdiReset, kPurgeIn) && usb.control(kFtdiReset, kPurgeOut);
}

/// Sends these bytes and collects what comes back, until it is as long as `expected` or the time is over.
std::vector<std::byte> ask(UsbTransfers& usb, std::span<const std::byte> sent, std::size_t expected,
                           double longest_s) {
  std::vector<std::byte> got;
  const double until_s = usb.now_s() + longest_s;
  bool waits = !usb.send(sent);
  UsbTransfers::Packet packet{};
  while (got.size() < expected && usb.now_s() < until_s && !usb.lost()) {
    const std::size_t count = usb.receive(packet, longest_s / 10.0);
    if (waits) waits = !usb.send(sent);
    if (count <= UsbTransfers::kStatus_bytes) continue;
    const auto bytes =
        std::span(packet).subspan(UsbTransfers::kStatus_bytes, count - UsbTransfers::kStatus_bytes);
    got.insert(got.end(), bytes.begin(), bytes.end());
  }
  return got;
}

std::vector<std::byte> bytes_of(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

/// Wakes the boot program.
bool greet(UsbTransfers& usb) {
  if (!purge(usb) || !usb.control(kLatency, 16) || !usb.control(kBaud, kGreetingBaud) ||
      !usb.control(kFormat, kEightBits) || !usb.control(kFlow, kNoFlow) || !usb.control(kModem, kRtsLow) ||
      !usb.control(kModem, kDtrLow) || !usb.control(kModem, kDtrHigh))
    return false;
  const auto wanted = bytes_of({0x0A, 0x44, 0x2C, 0x0D});
  // A zero may come first.
  const auto answer = ask(usb, bytes_of({0x0A, 0x43, 0x0D}), wanted.size() + 1, kWait_s);
  // clang 14 cannot compile std::ranges::search of libstdc++ 12.
  if (std::search(answer.begin(), answer.end(), wanted.begin(), wanted.end()) == answer.end()) return false;
  if (!usb.control(kModem, kDtrLow) || !usb.control(kBaud, kImageBaud)) return false;
  const auto ready = bytes_of({0x41});
  return ask(usb, ready, 1, kWait_s) == ready;
}

bool send_image(UsbTransfers& usb, const std::vector<std::byte>& image) {
  for (std::size_t done = 0; done < image.size(); done += kBlock_bytes) {
    const auto block = std::span(image).subspan(done, std::min(kBlock_bytes, image.size() - done));
    if (!std::ranges::equal(ask(usb, block, block.size(), kBlockWait_s), block)) return false;
  }
  return true;
}

Error firmware_error(std::string message) {
  return {ErrorCode::device, std::move(message), "falcon", Reason::device_silent};
}

}  // namespace

Result<std::vector<std::byte>> read_falcon_firmware(const std::string& file) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed))
    return Error{ErrorCode::device, "the file of the Falcon's firmware is not there", file};
  const auto size = std::filesystem::file_size(file, failed);
  if (failed || size == 0 || size > kLargest_bytes)
    return Error{ErrorCode::device,
                 "this is no firmware of the Falcon: it is empty or larger than a megabyte", file};
  std::ifstream stream(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(stream), {}};
  if (content.size() != size) return Error{ErrorCode::device, "the Falcon's firmware cannot be read", file};
  const auto bytes = std::as_bytes(std::span(content));
  return std::vector<std::byte>(bytes.begin(), bytes.end());
}

bool begin_falcon_packets(UsbTransfers& usb) {
  if (!purge(usb) || !usb.control(kLatency, 1) || !usb.control(kBaud, kPacketBaud) || !purge(usb))
    return false;
  const auto packet = falcon_packet({});
  for (int k = 0; k < kTries; ++k) {
    FalconReplies replies;
    if (replies.take(ask(usb, packet, packet.size(), kWait_s))) return true;
  }
  return false;
}

Result<void> load_falcon_firmware(UsbTransfers& usb, const std::vector<std::byte>& image) {
  bool greeted = false;
  for (int k = 0; k < kTries && !usb.lost(); ++k) {
    if (!greet(usb)) continue;
    greeted = true;
    if (!send_image(usb, image)) continue;
    if (begin_falcon_packets(usb)) return {};
    return firmware_error(
        "the file was loaded, but does not answer as the Falcon's firmware: it may be damaged");
  }
  if (usb.lost()) return firmware_error("the Falcon was unplugged while its firmware was loaded");
  return firmware_error(
      greeted ? "the firmware came back changed while it was loaded; check the cable, and plug it in again"
              : "the Falcon's boot program does not answer; check its power supply, and plug it in again");
}

}  // namespace palpable::device
