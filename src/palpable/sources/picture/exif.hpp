// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace palpable::sources {

/// One field of a TIFF directory, as EXIF and multi-picture files use it.
struct IfdEntry {
  std::uint16_t tag = 0;
  std::uint16_t type = 0;
  std::uint32_t count = 0;
  /// The first value if the field itself contains it; else the offset of the values.
  std::uint32_t value = 0;
};

/// Calls `visit` for each field of the first directory of a TIFF block (which starts with "II*\0" or
/// "MM\0*"); stops at damage. Returns the offset of the next directory, 0 = none.
std::uint32_t visit_first_ifd(std::span<const std::byte> tiff,
                              const std::function<void(const IfdEntry&)>& visit);

/// The same for the directory that begins at `at` bytes of the block.
std::uint32_t visit_ifd(std::span<const std::byte> tiff, std::uint32_t at,
                        const std::function<void(const IfdEntry&)>& visit);

/// Calls `visit` for each APPn segment before the picture data of a JPEG: the marker (0xE0 … 0xEF) and its
/// content.
void visit_jpeg_segments(std::span<const std::byte> jpeg,
                         const std::function<void(int marker, std::span<const std::byte> content)>& visit);

/// The EXIF orientation, 1 … 8, of a JPEG, PNG, WebP or TIFF file; 1 if it states none.
int orientation_of(std::span<const std::byte> file);

/// The focal length that the file states for a film of 36 x 24 mm, mm; nullopt where it states none.
std::optional<double> focal_length_35mm(std::span<const std::byte> file);

/// Rotates and mirrors a picture so that it is upright. `orientation` as EXIF defines it: 1 … 8.
Image upright(Image image, int orientation);

}  // namespace palpable::sources
