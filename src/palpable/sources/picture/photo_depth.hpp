// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/sources/picture/stored_image.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace palpable::sources {

/// Depth that a phone stores in a photograph.
struct PhotoDepth {
  enum class Coding : std::uint8_t {
    /// 0 at the near plane, 1 at the far one, linear in 1/Z (GDepth and Dynamic Depth "RangeInverse").
    range_inverse,
    /// 0 at the near plane, 1 at the far one, linear in Z ("RangeLinear").
    range_linear,
    /// 1 is nearest, linear in 1/Z: from far_m to near_m if both are known (HEIF's inverse Z and
    /// disparities).
    nearness
  };
  /// 0 … 1, in the orientation of the stored picture.
  Raster<float> values;
  Coding coding = Coding::nearness;
  /// Metres; nullopt if the phone does not know them.
  std::optional<double> near_m;
  std::optional<double> far_m;
};

/// The depth in a JPEG: Google's GDepth (XMP, extended over segments) or Dynamic Depth (a container after the
/// picture). nullopt: the picture contains none. Errors: invalid_input for depth that is announced but
/// damaged.
Result<std::optional<PhotoDepth>> depth_in_jpeg(std::span<const std::byte> file);

/// Whether a photograph, JPEG or HEIF, announces depth inside; its pixels are not decoded.
bool announces_depth(std::span<const std::byte> file);

/// Loads libheif's plug-ins. Must be called once before the functions below if files cannot be opened later.
void load_heif_plugins();

/// The primary picture of a HEIF file, upright; 9 to 15 bits are scaled to 16. Errors: invalid_input.
Result<StoredImage> decode_heif(std::span<const std::byte> file);

/// The auxiliary depth of a HEIF file's primary picture. Otherwise as depth_in_jpeg().
bool heif_announces_depth(std::span<const std::byte> file);
Result<std::optional<PhotoDepth>> depth_in_heif(std::span<const std::byte> file);

}  // namespace palpable::sources
