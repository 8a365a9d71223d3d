// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"

#include <cstddef>
#include <optional>

namespace palpable::vision {

/// The picture with at most `most_pixels` pixels and the same proportions, each the mean of the pixels that
/// it covers; nullopt if it is small enough. most_pixels > 0.
std::optional<Image> reduced(const Image& image, std::size_t most_pixels);

}  // namespace palpable::vision
