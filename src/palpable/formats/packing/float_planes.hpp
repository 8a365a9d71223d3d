// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace palpable::formats {

/// Floats in a form that any compressor makes small: differences of neighbours, as four planes of bytes, the
/// lowest first. `row`: values of one row, >= 1; a row begins with the difference to the row above. Exact for
/// every bit pattern.
std::vector<std::byte> planes_of(std::span<const float> values, std::size_t row);

/// The same bytes piece by piece, for floats of which only every `stride`-th is meant.
class PlanesOf {
 public:
  /// `values` begins with the first float that is meant; they must outlive this.
  PlanesOf(std::span<const float> values, std::size_t row, std::size_t stride);
  /// Four for each float.
  std::size_t bytes() const { return 4 * count_; }
  /// The next bytes, as many as `piece` holds.
  void next(std::span<std::byte> piece);

 private:
  std::uint32_t ordered_at(std::size_t i) const;

  std::span<const float> values_;
  std::size_t row_, stride_, count_;
  std::size_t plane_ = 0, at_ = 0;
};

/// The reverse of planes_of(). The size of `planes` must be a multiple of four.
std::vector<float> floats_of(std::span<const std::byte> planes, std::size_t row);

}  // namespace palpable::formats
