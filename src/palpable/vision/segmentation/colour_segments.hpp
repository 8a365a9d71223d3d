// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"

#include <vector>

namespace palpable::vision {

/// A picture divided into connected segments of one colour.
struct ColourSegments {
  /// The segment of each pixel, 0 … count - 1.
  Raster<int> of_pixel;
  int count = 0;
};

struct SegmentOptions {
  /// The mean shift's window: pixels to each side, and levels of 255.
  double radius_px = 5.0;
  double colour_levels = 4.0;
  /// Neighbours whose shifted colours differ by less than this, in the channel that differs most, belong
  /// together.
  int same_levels = 2;
  /// Smaller segments join the neighbour of the most similar colour.
  int least_pixels = 12;
};

/// Mean shift in position and colour (Comaniciu & Meer 2002), then connected components. Errors: failed, if
/// the picture is too large for the filter's memory.
Result<ColourSegments> segment_by_colour(const Raster<Rgb8>& picture, const SegmentOptions& options);

}  // namespace palpable::vision
