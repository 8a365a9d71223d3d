// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/files/file_bytes.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>

namespace palpable::sources {

enum class PictureFormat : std::uint8_t { png, jpeg, tiff, webp, bmp, pnm, pfm, tga, exr, heif };

/// Recognises the picture format by content, never by name; nullopt for unknown formats. TGA has no magic
/// number, so it is checked last and accepted only if its whole header is plausible.
std::optional<PictureFormat> picture_format_of(std::span<const std::byte> file);

/// Whether a picture, of which these are the first bytes, is decoded in another process (isolated/).
bool is_decoded_in_child(std::span<const std::byte> start);

/// Reads a picture: PNG, JPEG, TIFF, WebP, HEIC, OpenEXR, BMP, PBM/PGM/PPM, PFM or TGA, recognised by
/// content, with 8 or 16 bits or float samples. Alpha is kept, and the EXIF orientation is applied, so the
/// picture is upright. The least size is 1 x 1. Errors, invalid_input with the file's name: missing, not a
/// picture, damaged, truncated, more than kMaxPixels (checked before memory is allocated). Any thread.
Result<Image> read_picture(const std::filesystem::path& path);

/// The same from memory; errors without a place.
Result<Image> decode_picture(FileView file);

/// Splits a picture of a pair side by side into two halves, left first; an odd last column is dropped.
/// Errors: invalid_input for fewer than 2 columns.
Result<std::pair<Image, Image>> split_side_by_side(const Image& both);

/// The same for a pair one above the other; the upper half is the left picture.
Result<std::pair<Image, Image>> split_over_under(const Image& both);

}  // namespace palpable::sources
