// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/contours/contour_channels.hpp"
#include "palpable/vision/contours/contour_steps.hpp"
#include "palpable/vision/contours/contours.hpp"

namespace palpable::vision {

/// Edge vectors before thresholding: unit tangents and strength.
struct EdgeMap {
  Raster<float> tangent_x;
  Raster<float> tangent_y;
  Raster<float> strength;
  /// How much the finest scale tells, 0.05 ... 1: little in speckle and grain, whose energy is everywhere.
  float fine_trust = 1.0F;
  /// What Otsu's threshold must not fall below in this picture.
  float faintest = 0.0F;
};

/// Our own method: see docs/contours.md. Direction from the structure tensor of Gaussian derivatives of scale
/// 2 px; strength from the energy (first and second derivative) of scales 1, 2, 4 and 8 px together, less
/// what texture around it has; in grain also from how distinct the two sides are at 8, 16 and 32 px.
EdgeMap standard_edges(const Image& image, const Work& work);

/// For files, where time is not short: at each pixel two boxes side by side, turned in eight directions and
/// of three sizes; strength is how far their means differ beside the spread within them, which sees through
/// speckle and grain. The clearer the picture (fine_trust), the more the standard method counts instead. An
/// empty answer, where cancelled.
EdgeMap best_edges(const Image& image, const Work& work);

/// The paper's (3.2): Sobel's magnitude, and Climent's direction within their octants. Grey only.
EdgeMap paper_edges(const Image& image, const Work& work);

}  // namespace palpable::vision
