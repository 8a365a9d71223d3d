// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/packing/float_planes.hpp"

#include "palpable/core/check.hpp"

#include <bit>
#include <cstdint>

namespace palpable::formats {
namespace {

constexpr std::uint32_t kSign = 0x80000000U;

/// Maps a float's bits to an integer of the same order.
std::uint32_t ordered(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits & kSign) != 0U ? ~bits : bits | kSign;
}

float from_ordered(std::uint32_t value) {
  return std::bit_cast<float>((value & kSign) != 0U ? value & ~kSign : ~value);
}

/// Zigzag coding: differences 0, -1, 1, -2 … become 0, 1, 2, 3 …
std::uint32_t folded(std::uint32_t difference) { return (difference << 1U) ^ (0U - (difference >> 31U)); }
std::uint32_t unfolded(std::uint32_t value) { return (value >> 1U) ^ (0U - (value & 1U)); }

}  // namespace

PlanesOf::PlanesOf(std::span<const float> values, std::size_t row, std::size_t stride)
    : values_(values), row_(row), stride_(stride), count_((values.size() + stride - 1) / stride) {
  PALPABLE_CHECK(row > 0 && stride > 0);
}

std::uint32_t PlanesOf::ordered_at(std::size_t i) const { return ordered(values_[stride_ * i]); }

void PlanesOf::next(std::span<std::byte> piece) {
  std::uint32_t previous = at_ > 0 ? ordered_at(at_ - 1) : 0U;
  for (std::byte& byte : piece) {
    if (at_ == count_) at_ = 0, ++plane_;
    if (at_ % row_ == 0) previous = at_ == 0 ? 0U : ordered_at(at_ - row_);
    const std::uint32_t now = ordered_at(at_);
    byte = static_cast<std::byte>((folded(now - previous) >> (8 * plane_)) & 0xFFU);
    previous = now;
    ++at_;
  }
}

std::vector<std::byte> planes_of(std::span<const float> values, std::size_t row) {
  PlanesOf planes(values, row, 1);
  std::vector<std::byte> bytes(planes.bytes());
  planes.next(bytes);
  return bytes;
}

std::vector<float> floats_of(std::span<const std::byte> planes, std::size_t row) {
  PALPABLE_CHECK(row > 0 && planes.size() % 4 == 0);
  const std::size_t count = planes.size() / 4;
  std::vector<float> values(count);
  std::uint32_t previous = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % row == 0) previous = i == 0 ? 0U : ordered(values[i - row]);
    std::uint32_t small = 0;
    for (std::size_t plane = 0; plane < 4; ++plane)
      small |= std::to_integer<std::uint32_t>(planes[plane * count + i]) << (8 * plane);
    previous += unfolded(small);
    values[i] = from_ordered(previous);
  }
  return values;
}

}  // namespace palpable::formats
