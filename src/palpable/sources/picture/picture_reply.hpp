// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/sources/picture/photo_depth.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

// Pictures as the decoder process replies with them, and the decoders of decoders.hpp, exr.hpp and
// photo_depth.hpp once more, run in that process: what all of palpable calls. Errors as there, and those of
// isolated::decode().
namespace palpable::sources::isolated {

std::vector<std::byte> reply_of(const Image& image);
std::vector<std::byte> reply_of(const Raster<float>& values);
std::vector<std::byte> reply_of(const std::optional<PhotoDepth>& depth);

/// What a reply says, checked: size, count of samples, integer samples in 0 ... 1. Errors: the reply's own;
/// invalid_input for one that is not what it should be.
Result<Image> image_in(std::span<const std::byte> reply);
Result<Raster<float>> raster_in(std::span<const std::byte> reply);
Result<std::optional<PhotoDepth>> photo_depth_in(std::span<const std::byte> reply);

Result<Image> decode_tiff(std::span<const std::byte> file);
Result<Image> decode_webp(std::span<const std::byte> file);
Result<Image> decode_exr(std::span<const std::byte> file);
Result<Raster<float>> decode_exr_depth(std::span<const std::byte> file);
Result<Image> decode_heif(std::span<const std::byte> file);
Result<std::optional<PhotoDepth>> depth_in_heif(std::span<const std::byte> file);
/// False also for what cannot be read: reading it says why.
bool heif_announces_depth(std::span<const std::byte> file);

}  // namespace palpable::sources::isolated
