// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/camera.hpp"
#include "palpable/core/image.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>
#include <optional>

namespace palpable::vision {

/// What stands behind the things of a picture (Park & Howard 2012, 4.2).
struct Background {
  /// 255 where the background is seen, 0 elsewhere; as large as the picture.
  Raster<std::uint8_t> mask;
  double share = 0.0;
  /// What moves less than this between the pictures is no seed of a thing, pixels of disparity.
  double threshold_px = 0.0;
  /// Regions of the picture, and how many of the largest were taken away as elements of the background.
  int regions = 0;
  int removed = 0;
};

/// Pixels that move more than a threshold (by Otsu's method) are thinned to their middle lines; regions of
/// like colour (merge_regions) that hold such seeds are things. Of the other regions the largest are
/// background; their number follows from how many regions there are and how much of the picture they take.
/// What is left over belongs where its own disparity says. nullopt where near and far do not part: the
/// disparities lie within two pixels, or one side holds less than a hundredth of the picture. `left` and
/// `disparity_px` have the same size; polls work.cancel (nullopt then).
std::optional<Background> find_background(const Raster<Rgb8>& left, const Raster<float>& disparity_px,
                                          const Work& work);

/// The map in which what `goes` marks (not 0) lies at the level of the farthest thing that is left.
DisparityMap lowered(const DisparityMap& disparity, const Raster<std::uint8_t>& goes);

}  // namespace palpable::vision
