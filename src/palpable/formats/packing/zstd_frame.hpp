// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace palpable::formats {

/// Whether a frame may be given the memory that it states: at most 128 MiB, or at most 4000 times the frame's
/// own size. Only constant values compress further than that.
bool may_unpack(std::size_t packed_bytes, std::uint64_t stated_bytes);

/// Compresses bytes to one zstd frame with its size and a checksum, so that damage inside a well-formed
/// container is detected. `level` 1 ... 19. Errors: failed.
Result<std::vector<std::byte>> zstd_frame(std::span<const std::byte> bytes, int level);

/// The same for bytes that come in pieces, so that they need not be in memory at once. `bytes` is the size of
/// all pieces together; next(piece) fills the next ones, as many as the span holds.
Result<std::vector<std::byte>> zstd_frame(std::size_t bytes,
                                          const std::function<void(std::span<std::byte>)>& next, int level);

}  // namespace palpable::formats
