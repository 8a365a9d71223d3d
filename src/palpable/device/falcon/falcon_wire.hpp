// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace palpable::device {

/// What the Falcon's firmware is told: 16 bytes, as long as its replies.
struct FalconCommand {
  /// Motor words, -4095 to 4095; -10000 each N m.
  std::array<int, 3> motors{};
  /// A sum of the lights' bits and kHoming.
  std::uint8_t lights = 0;

  static constexpr std::uint8_t kHoming = 1, kGreen = 2, kBlue = 4, kRed = 8;
  static constexpr int kMostMotor = 4095;
  static constexpr double kPerTorque_1_per_Nm = -10000.0;
};

struct FalconReply {
  std::array<int, 3> counts{};
  /// Bits 0 to 3 buttons (right, forward, centre, left), 4 to 6 the arms that are homed.
  std::uint8_t status = 0;

  std::uint32_t buttons() const { return status & 15U; }
  bool is_homed() const { return (status & 0x70U) == 0x70U; }
};

using FalconPacket = std::array<std::byte, 16>;

/// Numbers beyond kMostMotor are cut.
FalconPacket falcon_packet(const FalconCommand& command) noexcept;

/// The motor words for these torques, N m, to the nearest step; all reduced by one factor where one exceeds
/// what a motor takes, so that the force keeps its direction. Zero if one is not finite.
std::array<int, 3> motor_words(const std::array<double, 3>& torques_Nm) noexcept;

/// The angle of an arm at a number of counts, rad: 1280 counts a turn of a capstan of 14.25 mm on a drum of
/// 110 mm, and 35 degrees at zero.
double arm_angle(int counts) noexcept;

/// The radians of one count.
extern const double kFalconCount_rad;

/// Finds replies in bytes that arrive in pieces, with others between them. Tick path.
class FalconReplies {
 public:
  /// The newest reply that these bytes complete.
  std::optional<FalconReply> take(std::span<const std::byte> bytes) noexcept;
  void reset() noexcept { size_ = 0; }

 private:
  FalconPacket packet_{};
  std::size_t size_ = 0;
};

}  // namespace palpable::device
