// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

// Recognises formats by their first bytes, without their libraries.
namespace palpable::sources {

/// Whether this is a HEIF picture (HEIC or AVIF; libheif distinguishes them).
bool is_heif(std::span<const std::byte> file);

/// Whether this is an OpenEXR picture.
bool is_exr(std::span<const std::byte> file);

/// Whether this is an animated PNG, whose first picture is the one that every reader shows. The chunk that
/// says so stands before the picture data; nothing behind the bytes given is looked at.
bool is_animated_png(std::span<const std::byte> file);

}  // namespace palpable::sources
