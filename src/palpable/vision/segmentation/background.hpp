// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/segmentation/ground.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace palpable::vision {

struct BackgroundMaskOptions {
  /// An object is nearer than the ground by at least this disparity, and by at least this many of the
  /// ground's standard deviations. 0 … 20 px; 0 … 20.
  double least_height_px = 0.5;
  double height_sigmas = 3.0;
  /// Pixels of one surface differ by at most this much from their neighbours. 0.05 … 20 px.
  double step_px = 1.0;
  /// Regions of an object smaller than this share of the picture are noise. 0 … 0.1.
  double least_object_share = 0.0005;
  /// A plane is the background if this share of the known pixels lies on it, and at most this share behind
  /// it. 0 … 1 each.
  double least_plane_share = 0.3;
  double most_behind_share = 0.02;
  /// The fit of that plane, which may lie in any direction, and which pixels are on it.
  GroundPlaneOptions plane;
  GroundMaskOptions mask;
  /// If no plane is the background: complexity of the colour regions (merge_regions, 1 … 1024); the least
  /// range of disparities (0 … 100 px); share of a region nearer than the threshold that makes it an object
  /// (0 … 1). In a region that is background, share of the range beyond the threshold from which a pixel is
  /// not (0 … 1).
  double region_complexity = 32.0;
  double least_range_px = 2.0;
  double object_share = 0.5;
  double clear_share = 0.1;
  /// The background covers at least this share of the picture, and leaves at least this share. 0 … 0.5.
  double least_share = 0.01;
};
std::vector<Parameter> parameters_of(BackgroundMaskOptions& options);

/// The background of a picture's objects (Park & Howard 2012, 4.2, is the last of three methods).
struct Background {
  /// How it was found: as a plane with nothing behind it, or by a threshold of disparity and colour regions.
  enum class By { plane, regions };
  By by = By::plane;
  /// 255 where the background is seen, 0 elsewhere; as large as the picture.
  Raster<std::uint8_t> mask;
  double share = 0.0;
  /// For By::regions: pixels of smaller disparity are no seeds of an object.
  double threshold_px = 0.0;
};

/// Objects on the ground, 255 / 0, as large as the picture: connected surfaces in front of the ground's plane
/// with ground on both sides along the row or the column. So a wall at the ground's end is none.
Raster<std::uint8_t> objects_on_ground(const Ground& ground, const Raster<float>& disparity_px,
                                       const BackgroundMaskOptions& options = {});

/// Finds the background, which excludes the ground and the objects on it. It is the best supported plane of
/// any orientation with nothing behind it (a wall, or a table seen from directly above); everything in front
/// of it is an object. If no plane has enough support, the paper's method is used. Pixels with a disparity
/// above Otsu's threshold are thinned to their medial axes. Colour regions with such seeds are objects. Of
/// the others the largest are background; their number follows from the number and the sizes of the regions.
/// The rest is decided by its own disparity. nullopt if nothing is behind the objects, or near and far cannot
/// be separated. `left` and `disparity_px` have the same size; polls work.cancel (nullopt then).
std::optional<Background> find_background(const Raster<Rgb8>& left, const Raster<float>& disparity_px,
                                          const Ground* ground, const Work& work,
                                          const BackgroundMaskOptions& options = {});

/// The map with the marked pixels (not 0) of `lower` at the level of the farthest remaining object.
DisparityMap lowered(const DisparityMap& disparity, const Raster<std::uint8_t>& lower);

}  // namespace palpable::vision
