// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace palpable::formats {

/// Bytes packed by zstd. Errors: failed.
Result<std::vector<std::byte>> pack_bytes(std::span<const std::uint8_t> bytes);

/// The same bytes back. What states more than `most` bytes, or more than zstd could have packed into what is
/// there, is damage, and no memory is taken for it. Errors: invalid_input.
Result<std::vector<std::uint8_t>> unpack_bytes(std::span<const std::byte> packed, std::size_t most);

}  // namespace palpable::formats
