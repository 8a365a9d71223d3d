// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/two_diy/two_diy_variant.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace palpable::device {

// The 2DIY's messages: numbers are little-endian, floats of 4 bytes, no checksums.

/// The number that messages and answers carry; several boards on one line would have several.
inline constexpr std::uint8_t kTwoDiyId = 1;

using TwoDiySetup = std::array<std::byte, 26>;
using TwoDiyTorques = std::array<std::byte, 10>;
using TwoDiyReset = std::array<std::byte, 2>;

/// Defines motors and encoders and sets the encoders to their angles at home: the handle must be there.
TwoDiySetup setup_message(const TwoDiyVariant& variant) noexcept;
/// Sets the torques of the motors on ports 1 and 2, N m; the board answers with the angles.
TwoDiyTorques torque_message(std::array<float, 2> by_port_Nm) noexcept;
/// The board forgets its setup, and its motors are free.
TwoDiyReset reset_message() noexcept;

/// Finds the answers to torque messages in the bytes that arrive. After a byte that cannot begin an answer,
/// or an impossible angle, it goes on with the next byte. Allocates nothing.
class TwoDiyAnswers {
 public:
  /// Bytes of an answer.
  static constexpr std::size_t kLength = 9;

  /// The angles (degrees, in the board's order) of the last complete answer among these bytes, if any.
  std::optional<std::array<float, 2>> take(std::span<const std::byte> bytes) noexcept;
  /// Forgets the start of an answer.
  void reset() noexcept { held_ = 0; }
  /// Complete answers so far, and bytes that belonged to none.
  std::uint64_t complete() const noexcept { return complete_; }
  std::uint64_t dropped() const noexcept { return dropped_; }

 private:
  std::optional<std::array<float, 2>> answer() const noexcept;
  void drop_one() noexcept;

  std::array<std::byte, kLength> bytes_{};
  std::size_t held_ = 0;
  std::uint64_t complete_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace palpable::device
