// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>

namespace palpable::sources {

/// The colours of an OpenEXR file: R, G, B with A where it is there, or Y; floats as they are (linear light).
/// Its data window is the picture. Errors: invalid_input for damage, deep files, no such channels, more than
/// kMaxPixels.
Result<Image> decode_exr(std::span<const std::byte> file);

/// The depth of an OpenEXR file: the channel Z (also with a layer's name before it, "depth.Z"), or the only
/// one. What renderers write for "nothing there", 1e10 and more, stays as it is. Errors: as decode_exr().
Result<Raster<float>> decode_exr_depth(std::span<const std::byte> file);

}  // namespace palpable::sources
