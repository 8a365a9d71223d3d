// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace palpable::sources {

/// The arrangement of a pair in one picture. "crossed": the right eye's picture comes first (left or above),
/// for cross-eyed viewing.
enum class StereoLayout : std::uint8_t {
  /// As the file states; else side by side for pictures wider than high, and one above the other for others.
  automatic,
  side_by_side,
  side_by_side_crossed,
  over_under,
  over_under_crossed
};

struct StereoPictures {
  Image left;
  Image right;
  /// Information for the user, one sentence each.
  std::vector<std::string> notes;
};

/// Whether a JPEG states that it contains a stereo pair: a multi-picture file (MPO) with two pictures of the
/// kind "disparity", or a JPS descriptor. Multi-picture files of phones with previews or gain maps do not
/// count. The start of the file, up to its picture data, is sufficient.
bool is_stereo_jpeg(std::span<const std::byte> file);

/// Cuts a picture that contains a pair into two. Errors: invalid_input for one that is too narrow or too low.
Result<StereoPictures> split_pair(const Image& both, StereoLayout layout);

/// Decodes a pair in one file: MPO, JPS (its descriptor is applied, and squeezed halves are widened), or any
/// picture that contains both. Errors: invalid_input.
Result<StereoPictures> decode_stereo(std::span<const std::byte> file,
                                     StereoLayout layout = StereoLayout::automatic);

/// Reads a pair from one file or two, left first. Errors: invalid_input with the file's name; two pictures of
/// different size, naming both sizes.
Result<StereoPictures> read_stereo(std::span<const std::filesystem::path> files,
                                   StereoLayout layout = StereoLayout::automatic);

}  // namespace palpable::sources
