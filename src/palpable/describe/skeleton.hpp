// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace palpable::describe {

/// Set pixels are not 0. Functions that read neighbours require a border of one unset pixel.
using Mask = Raster<std::uint8_t>;

/// Offsets to the eight neighbours of a pixel, clockwise from above; those of even index share a side with
/// it.
inline constexpr std::array<Pixel, 8> kAround{
    {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}}};

/// Thins the set pixels to 8-connected lines one pixel wide (Zhang & Suen 1984) and removes the corner pixels
/// of staircases.
void thin_to_lines(Mask& mask);

enum class Connected { over_sides, over_corners_too };

/// Flood fill: returns the pixels connected to `start` that have its value, and writes `mark` (not 0) to
/// `marks` there. Pixels that are already marked are not entered.
std::vector<Pixel> flood(const Mask& mask, Pixel start, int mark, Raster<int>& marks, Connected connected);

/// A path along a skeleton between two nodes. A node is an end or a point where three or more paths meet.
struct SkeletonPath {
  static constexpr int kFreeEnd = -1;
  /// From the first node to the last one, without the pixels of the nodes.
  std::vector<Pixel> pixels;
  /// Indices into Skeleton::nodes, or kFreeEnd. A ring without a node has free ends and is closed.
  int first = kFreeEnd;
  int last = kFreeEnd;
  bool closed = false;
};

struct Skeleton {
  std::vector<SkeletonPath> paths;
  /// Centroids of the junctions: points where three or more paths meet.
  std::vector<std::array<double, 2>> nodes;
};

/// Splits lines one pixel wide into paths and junctions.
Skeleton paths_of(const Mask& lines);

}  // namespace palpable::describe
