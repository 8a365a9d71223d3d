// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>

namespace palpable::formats {

/// A baseline or progressive JPEG: grey, YCbCr, RGB or CMYK (made RGB). What follows its end marker is not
/// read; the orientation in its EXIF block is not applied (sources::read_picture does). Errors: invalid_input
/// for what is damaged or cut off (libjpeg alone would fill the missing part with grey) or larger than
/// kMaxPixels (asked before memory is taken).
Result<Image> decode_jpeg(std::span<const std::byte> file);

}  // namespace palpable::formats
