// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::formats {

/// Compresses bytes to one zstd frame with its size and a checksum, so that damage inside a well-formed
/// container is detected. `level` 1 ... 19. Errors: failed.
Result<std::vector<std::byte>> zstd_frame(std::span<const std::byte> bytes, int level);

}  // namespace palpable::formats
