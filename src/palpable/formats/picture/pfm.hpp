// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::formats {

/// Decodes a portable float map of one ("Pf") or three ("PF") channels in either byte order, with rows stored
/// from the bottom up. Values are exact; the magnitude of the header's scale is not applied. Errors:
/// invalid_input for a bad header, a truncated file, or more than kMaxPixels.
Result<Image> decode_pfm(std::span<const std::byte> file);

/// A one-channel map in little-endian order.
std::vector<std::byte> encode_pfm(const Raster<float>& values);

}  // namespace palpable::formats
