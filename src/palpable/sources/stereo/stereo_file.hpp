// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace palpable::sources {

/// How one picture holds two. "crossed": the right eye's picture comes first (left or above), for viewing
/// with crossed eyes.
enum class StereoLayout : std::uint8_t {
  /// What the file itself states; else side by side for pictures wider than high, one above the other for
  /// others.
  automatic,
  side_by_side,
  side_by_side_crossed,
  over_under,
  over_under_crossed
};

struct StereoPictures {
  Image left;
  Image right;
  /// What the person should know, a sentence each.
  std::vector<std::string> notes;
};

/// Whether a JPEG states that it holds a stereo pair: a multi-picture file (MPO) with two pictures of the
/// kind "disparity", or a JPS descriptor. The file's start, up to its picture data, is enough. A phone's
/// multi-picture files with previews or gain maps are not.
bool is_stereo_jpeg(std::span<const std::byte> file);

/// The pair in one file: MPO, JPS (its descriptor is obeyed; squeezed halves are widened again), or any
/// picture that holds both. Errors: invalid_input.
Result<StereoPictures> decode_stereo(std::span<const std::byte> file,
                                     StereoLayout layout = StereoLayout::automatic);

/// The pair in one file or two, left first. Errors: invalid_input with the file's name; two pictures of
/// different size, naming both sizes.
Result<StereoPictures> read_stereo(std::span<const std::filesystem::path> files,
                                   StereoLayout layout = StereoLayout::automatic);

}  // namespace palpable::sources
