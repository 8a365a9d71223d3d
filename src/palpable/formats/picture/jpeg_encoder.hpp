// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <vector>

namespace palpable::formats {

/// Encodes a picture as a baseline JPEG, which loses detail: `quality` 1 ... 100. Errors: failed, for a
/// picture that JPEG cannot hold (no side, or one above 65500).
Result<std::vector<std::byte>> encode_jpeg(const Raster<Rgb8>& picture, int quality);

}  // namespace palpable::formats
