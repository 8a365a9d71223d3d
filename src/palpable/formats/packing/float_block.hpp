// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::formats {

/// Compresses floats without loss. Neighbours in a row differ little, so the differences of their bit
/// patterns (mapped to integers of the same order) are small. The differences are split into four byte planes
/// and compressed by zstd. `row` > 0 is the number of values per row. NaN and infinity are kept. Only
/// every `stride`-th value is meant, from the first. Needs little memory beside the result. Errors: failed.
Result<std::vector<std::byte>> pack_floats(std::span<const float> values, std::size_t row,
                                           std::size_t stride = 1);

/// Decompresses the same values bit by bit. `count` is the expected number; another stated size is refused
/// before memory is allocated. Errors: invalid_input.
Result<std::vector<float>> unpack_floats(std::span<const std::byte> packed, std::size_t count,
                                         std::size_t row);

}  // namespace palpable::formats
