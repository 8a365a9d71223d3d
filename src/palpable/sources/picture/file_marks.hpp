// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

// The kinds of pictures that the decoder process reads, by the marks at their start; without their libraries.
namespace palpable::sources {

/// Whether the bytes begin a HEIF picture (HEIC or AVIF; libheif tells the two apart).
bool is_heif(std::span<const std::byte> file);

/// Whether the bytes begin an OpenEXR picture.
bool is_exr(std::span<const std::byte> file);

}  // namespace palpable::sources
