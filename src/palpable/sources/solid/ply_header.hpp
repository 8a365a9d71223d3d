// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>

namespace palpable::sources {

/// Whether a PLY file can hold what its header states: each element takes at least the bytes of its
/// properties (binary; a list at least its count) or a line (ASCII). Asked before anything is read, so that
/// neither a count out of the air nor a file that was cut off takes memory or is half used. Errors:
/// invalid_input.
Result<void> check_ply(std::span<const std::byte> file);

}  // namespace palpable::sources
