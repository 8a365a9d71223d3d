// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace palpable::formats {

/// Compresses bytes by zstd. Errors: failed.
Result<std::vector<std::byte>> pack_bytes(std::span<const std::uint8_t> bytes);

/// Decompresses them. A stated size above `most`, or above what zstd can compress into `packed`, is refused
/// before memory is allocated. Errors: invalid_input.
Result<std::vector<std::uint8_t>> unpack_bytes(std::span<const std::byte> packed, std::size_t most);

}  // namespace palpable::formats
