// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::formats {

/// Bytes packed by zstd as one frame that states its size and a checksum of its content, so that damage
/// inside a well-formed container is noticed too. `level` 1 ... 19. Errors: failed.
Result<std::vector<std::byte>> zstd_frame(std::span<const std::byte> bytes, int level);

}  // namespace palpable::formats
