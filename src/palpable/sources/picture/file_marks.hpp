// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

// Recognises the formats that the decoder process reads by their first bytes, without their libraries.
namespace palpable::sources {

/// Whether this is a HEIF picture (HEIC or AVIF; libheif distinguishes them).
bool is_heif(std::span<const std::byte> file);

/// Whether this is an OpenEXR picture.
bool is_exr(std::span<const std::byte> file);

}  // namespace palpable::sources
