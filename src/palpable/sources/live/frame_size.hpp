// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstdint>

namespace palpable::sources {

/// The most pixels of a frame: more than any depth camera gives (4096 x 2048). Reading twice as many takes
/// longer than half a second, so that the surface would be older than a hand can use.
inline constexpr std::uint64_t kMostFramePixels = std::uint64_t{1} << 23U;

/// Invalid input, without a place: this number of pixels is above kMostFramePixels.
Error too_many_pixels(std::uint64_t pixels);

/// Errors: invalid_input, without a place, for more pixels than kMostFramePixels, or none.
Result<void> check_frame_size(int width, int height);

}  // namespace palpable::sources
