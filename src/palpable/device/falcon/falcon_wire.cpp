// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/falcon/falcon_wire.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpable::device {
namespace {

constexpr std::byte kBegin{'<'}, kEnd{'>'};
constexpr unsigned kLetter = 0x41;
constexpr double kZero_deg = 35.0;
constexpr double kCount_deg = 360.0 / 1280.0 * 14.25 / 110.0;

std::byte letter(unsigned nibble) noexcept { return static_cast<std::byte>(kLetter + (nibble & 15U)); }

/// The bits of a letter; more than `most` if it is none.
unsigned bits_of(std::byte letter) noexcept { return std::to_integer<unsigned>(letter) - kLetter; }

std::optional<FalconReply> reply_in(const FalconPacket& packet) noexcept {
  constexpr unsigned kMostNibble = 15, kMostStatus = 127;
  FalconReply reply;
  for (std::size_t k = 0; k < 3; ++k) {
    unsigned word = 0;
    for (std::size_t n = 0; n < 4; ++n) {
      const unsigned nibble = bits_of(packet[1 + 4 * k + n]);
      if (nibble > kMostNibble) return {};
      word |= nibble << (4U * n);
    }
    reply.counts[k] = static_cast<std::int16_t>(static_cast<std::uint16_t>(word));
  }
  const unsigned status = bits_of(packet[13]);
  if (status > kMostStatus) return {};
  reply.status = static_cast<std::uint8_t>(status);
  return reply;
}

}  // namespace

const double kFalconCount_rad = kCount_deg * std::numbers::pi / 180.0;

FalconPacket falcon_packet(const FalconCommand& command) noexcept {
  FalconPacket packet{};
  packet[0] = kBegin;
  for (std::size_t k = 0; k < 3; ++k) {
    const int cut = std::clamp(command.motors[k], -FalconCommand::kMostMotor, FalconCommand::kMostMotor);
    const auto word = static_cast<std::uint16_t>(cut);
    for (std::size_t n = 0; n < 4; ++n)
      packet[1 + 4 * k + n] = letter(static_cast<unsigned>(word) >> (4U * n));
  }
  packet[13] = letter(command.lights);
  packet[14] = letter(0);
  packet[15] = kEnd;
  return packet;
}

std::array<int, 3> motor_words(const std::array<double, 3>& torques_Nm) noexcept {
  double most = 0.0;
  for (const double torque : torques_Nm) {
    if (!std::isfinite(torque)) return {};
    most = std::max(most, std::abs(torque * FalconCommand::kPerTorque_1_per_Nm));
  }
  constexpr double kMost = FalconCommand::kMostMotor;
  const double gain = FalconCommand::kPerTorque_1_per_Nm * (most > kMost ? kMost / most : 1.0);
  std::array<int, 3> words{};
  for (std::size_t k = 0; k < 3; ++k) words[k] = static_cast<int>(std::nearbyint(gain * torques_Nm[k]));
  return words;
}

double arm_angle(int counts) noexcept {
  return kZero_deg * std::numbers::pi / 180.0 + kFalconCount_rad * static_cast<double>(counts);
}

std::optional<FalconReply> FalconReplies::take(std::span<const std::byte> bytes) noexcept {
  std::optional<FalconReply> newest;
  for (const std::byte byte : bytes) {
    if (byte == kBegin) size_ = 0;
    // What follows a whole packet, or nothing that began one, is no reply.
    if (size_ == 0 && byte != kBegin) continue;
    packet_[size_++] = byte;
    if (size_ < packet_.size()) continue;
    size_ = 0;
    if (byte != kEnd) continue;
    if (const auto reply = reply_in(packet_)) newest = reply;
  }
  return newest;
}

}  // namespace palpable::device
