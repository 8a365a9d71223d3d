// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/sources/map/map_extract.hpp"

#include <cstddef>
#include <span>
#include <vector>

// Extracts in replies of the decoder process.
namespace palpable::sources::isolated {

std::vector<std::byte> reply_of(const MapExtract& extract);

/// Decodes a reply. Errors: those in the reply; invalid_input for an invalid reply.
Result<MapExtract> map_extract_in(std::span<const std::byte> reply);

}  // namespace palpable::sources::isolated
