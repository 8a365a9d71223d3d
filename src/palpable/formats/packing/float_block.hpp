// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::formats {

/// Floats made small without loss: neighbours in a row differ little, so the differences of their bit
/// patterns (mapped to integers of the same order) are small; their four bytes are sorted into four planes
/// and packed by zstd. `row` values make one row, row > 0. NaN and infinity are kept too. Errors: failed.
Result<std::vector<std::byte>> pack_floats(std::span<const float> values, std::size_t row);

/// The same values back, bit by bit. `count` is known from elsewhere; what states another size is damage, and
/// no memory is taken for it. Errors: invalid_input.
Result<std::vector<float>> unpack_floats(std::span<const std::byte> packed, std::size_t count,
                                         std::size_t row);

}  // namespace palpable::formats
