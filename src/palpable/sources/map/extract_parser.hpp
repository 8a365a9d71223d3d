// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/sources/map/map_extract.hpp"

#include <cstddef>
#include <span>

namespace palpable::sources {

/// Parses an extract with libosmium. Errors: invalid_input; also throws std::exception for a damaged file.
/// Only for the decoder process and the fuzzers.
Result<MapExtract> parse_map_extract(std::span<const std::byte> file);

}  // namespace palpable::sources
