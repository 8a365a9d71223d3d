// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/files/file_bytes.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/sources/picture/photo_depth.hpp"
#include "palpable/sources/picture/stored_image.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

// Pictures in replies of the decoder process; and the decoders of decoders.hpp, exr.hpp and photo_depth.hpp,
// run in that process, which all of palpable uses. Errors as there, and those of isolated::decode().
namespace palpable::sources::isolated {

/// The start of the reply; the image's samples follow it.
std::vector<std::byte> reply_head(const StoredImage& image);
/// For pictures of floats (32 bits).
std::vector<std::byte> reply_of(const Image& image);
std::vector<std::byte> reply_of(const Raster<float>& values);
std::vector<std::byte> reply_of(const std::optional<PhotoDepth>& depth);

/// Decodes and checks a reply: size and number of samples. Errors: those in the reply; invalid_input for an
/// invalid reply.
Result<Image> image_in(std::span<const std::byte> reply);
Result<Raster<float>> raster_in(std::span<const std::byte> reply);
Result<std::optional<PhotoDepth>> photo_depth_in(std::span<const std::byte> reply);

Result<Image> decode_tiff(FileView file);
Result<Image> decode_webp(FileView file);
Result<Image> decode_exr(FileView file);
Result<Raster<float>> decode_exr_depth(FileView file);
Result<Image> decode_heif(FileView file);
Result<std::optional<PhotoDepth>> depth_in_heif(FileView file);
/// Also false for an unreadable file; reading it gives the error.
bool heif_announces_depth(FileView file);

}  // namespace palpable::sources::isolated
