// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace palpable::describe {

/// Pixels that are set (not 0). Whatever reads neighbours needs a border of one pixel that is not set.
using Mask = Raster<std::uint8_t>;

/// The eight neighbours of a pixel, clockwise from above; those of even index share a side with it.
inline constexpr std::array<Pixel, 8> kAround{
    {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}}};

/// Thins what is set to lines one pixel wide that are connected over eight neighbours (Zhang & Suen 1984),
/// without the corner pixels of stairs.
void thin_to_lines(Mask& mask);

enum class Connected { over_sides, over_corners_too };

/// The pixels with the value of `start` that are connected to it, with `mark` (not 0) written to `marks`;
/// marked ones are not entered.
std::vector<Pixel> flood(const Mask& mask, Pixel start, int mark, Raster<int>& marks, Connected connected);

/// A path along a skeleton between two nodes: ends and places where three or more paths meet.
struct SkeletonPath {
  static constexpr int kFreeEnd = -1;
  /// From the first node to the last one, without the nodes' own pixels.
  std::vector<Pixel> pixels;
  /// Indices into Skeleton::nodes, or kFreeEnd. A ring without a node has free ends and is closed.
  int first = kFreeEnd;
  int last = kFreeEnd;
  bool closed = false;
};

struct Skeleton {
  std::vector<SkeletonPath> paths;
  /// The middle of each place where three or more paths meet.
  std::vector<std::array<double, 2>> nodes;
};

/// The paths of lines one pixel wide.
Skeleton paths_of(const Mask& lines);

}  // namespace palpable::describe
