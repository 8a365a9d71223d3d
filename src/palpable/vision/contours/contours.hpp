// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/contours/contour_options.hpp"

#include <string>
#include <vector>

namespace palpable::vision {

/// The boundaries of a picture as a density of edge vectors e, in image axes (x right, y down). Directions
/// are undirected.
struct ContourMap {
  /// Unit tangent (zero where there is no structure at all) and strength 0 ... 1; 0 below half the threshold.
  Raster<float> tangent_x;
  Raster<float> tangent_y;
  Raster<float> strength;
  /// Boundaries one pixel wide: the strength on ridges of lines that reach the threshold; 0 elsewhere.
  Raster<float> line;
  double threshold = 0.0;
  /// Share of pixels at or above the threshold.
  double boundary_fraction = 0.0;
  std::vector<std::string> notes;
};

/// Extracts the boundaries of a picture. Errors: invalid_input for
/// pictures under 8 x 8 or with a sample that is not finite, usage as check(), interrupted.
Result<ContourMap> find_contours(const Image& image, const ContourOptions& options, const Work& work);

}  // namespace palpable::vision
