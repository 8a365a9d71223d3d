// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/two_diy/two_diy_wire.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace palpable::device {
namespace {

enum Command : std::uint8_t { kReset = 0, kSetup = 1, kTorques = 2 };

/// An encoder that was turned further has lost its home.
constexpr float kGreatestAngle_deg = 3600.0F;

/// Writes numbers one after the other.
class Bytes {
 public:
  explicit Bytes(std::span<std::byte> to) : to_(to) {}
  Bytes& byte(std::uint8_t value) {
    to_[at_++] = std::byte{value};
    return *this;
  }
  Bytes& number(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (unsigned shift = 0; shift < 32; shift += 8) byte(static_cast<std::uint8_t>(bits >> shift));
    return *this;
  }

 private:
  std::span<std::byte> to_;
  std::size_t at_ = 0;
};

float number_at(std::span<const std::byte> bytes) {
  std::uint32_t bits = 0;
  for (unsigned k = 0; k < 4; ++k) bits |= std::to_integer<std::uint32_t>(bytes[k]) << (8 * k);
  return std::bit_cast<float>(bits);
}

const TwoDiyJoint& joint_on(const TwoDiyVariant& variant, std::uint8_t port) {
  return variant.joints[0].port == port ? variant.joints[0] : variant.joints[1];
}

}  // namespace

TwoDiySetup setup_message(const TwoDiyVariant& variant) noexcept {
  constexpr std::uint8_t kBothPorts = 0b11;
  const TwoDiyJoint& one = joint_on(variant, 1);
  const TwoDiyJoint& two = joint_on(variant, 2);
  TwoDiySetup message{};
  Bytes bytes(message);
  bytes.byte(kSetup).byte(kTwoDiyId);
  bytes.byte(kBothPorts).byte(one.direction).byte(two.direction);
  bytes.byte(kBothPorts).byte(one.direction).byte(two.direction);
  // No sensors and no outputs on pins.
  bytes.byte(0).byte(0);
  bytes.number(one.home_deg).number(one.counts_per_turn);
  bytes.number(two.home_deg).number(two.counts_per_turn);
  return message;
}

TwoDiyTorques torque_message(std::array<float, 2> by_port_Nm) noexcept {
  TwoDiyTorques message{};
  Bytes(message).byte(kTorques).byte(kTwoDiyId).number(by_port_Nm[0]).number(by_port_Nm[1]);
  return message;
}

TwoDiyReset reset_message() noexcept { return {std::byte{kReset}, std::byte{kTwoDiyId}}; }

std::optional<std::array<float, 2>> TwoDiyAnswers::take(std::span<const std::byte> bytes) noexcept {
  std::optional<std::array<float, 2>> last;
  for (const std::byte byte : bytes) {
    bytes_[held_++] = byte;
    while (held_ > 0 && bytes_[0] != std::byte{kTwoDiyId}) drop_one();
    if (held_ < kLength) continue;
    if (const auto found = answer()) {
      last = found;
      ++complete_;
      held_ = 0;
    } else {
      drop_one();
    }
  }
  return last;
}

std::optional<std::array<float, 2>> TwoDiyAnswers::answer() const noexcept {
  const std::span<const std::byte> numbers = std::span(bytes_).subspan(1);
  const std::array angles{number_at(numbers), number_at(numbers.subspan(4))};
  for (const float angle : angles)
    if (!(std::abs(angle) <= kGreatestAngle_deg)) return std::nullopt;
  return angles;
}

void TwoDiyAnswers::drop_one() noexcept {
  ++dropped_;
  --held_;
  std::copy_n(bytes_.begin() + 1, held_, bytes_.begin());
}

}  // namespace palpable::device
