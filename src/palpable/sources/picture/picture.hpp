// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>

namespace palpable::sources {

enum class PictureFormat : std::uint8_t { png, jpeg, tiff, webp, bmp, pnm, pfm, tga, exr, heif };

/// What kind of picture these bytes are, by their content, never by a name; nullopt for none of them. TGA has
/// no mark at its start, so it is asked last and believed only where its whole header makes sense.
std::optional<PictureFormat> picture_format_of(std::span<const std::byte> file);

/// The picture in a file: PNG, JPEG, TIFF, WebP, HEIC, OpenEXR, BMP, PBM/PGM/PPM, PFM or TGA, recognised by
/// content, with 8 or 16 bits or float samples; alpha is kept; the orientation that a camera noted is
/// applied, so the picture stands upright. 1 x 1 is a picture. Errors, invalid_input with the file's name:
/// missing, not a picture, damaged, cut off, more than kMaxPixels (asked before memory is taken). Any thread.
Result<Image> read_picture(const std::filesystem::path& path);

/// The same from memory; errors without a place.
Result<Image> decode_picture(std::span<const std::byte> file);

/// One picture that holds a pair side by side, cut in two halves, left first; an odd last column is dropped.
/// Errors: invalid_input for less than 2 columns.
Result<std::pair<Image, Image>> split_side_by_side(const Image& both);

/// The same for a pair one above the other: the left eye's picture is the upper half.
Result<std::pair<Image, Image>> split_over_under(const Image& both);

}  // namespace palpable::sources
