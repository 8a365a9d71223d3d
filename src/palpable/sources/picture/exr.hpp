// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>

namespace palpable::sources {

/// Decodes the colours of an OpenEXR file: R, G, B and optionally A, or Y; floats without conversion (linear
/// light). The data window is the picture. Errors: invalid_input for damage, deep files, missing channels,
/// more than kMaxPixels.
Result<Image> decode_exr(std::span<const std::byte> file);

/// Decodes the depth of an OpenEXR file: the channel Z (also with a layer name, "depth.Z"), or the only
/// channel. Values of 1e10 and more, which renderers write where there is nothing, are not changed. Errors:
/// as decode_exr().
Result<Raster<float>> decode_exr_depth(std::span<const std::byte> file);

}  // namespace palpable::sources
