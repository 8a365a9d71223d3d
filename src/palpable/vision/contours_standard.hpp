// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/contour_steps.hpp"
#include "palpable/vision/contours.hpp"

namespace palpable::vision {

/// Edge vectors before thresholding: unit tangents and strength.
struct EdgeMap {
  Raster<float> tangent_x;
  Raster<float> tangent_y;
  Raster<float> strength;
};

/// Our own method: see docs/contours.md. Direction from the structure tensor of Gaussian derivatives of scale
/// 2 px; strength from the energy (first and second derivative) of scales 1, 2 and 4 px together, less what
/// texture around it has.
EdgeMap standard_edges(const Image& image, const Work& work);

/// The paper's (3.2): Sobel's magnitude, and Climent's direction within their octants. Grey only.
EdgeMap paper_edges(const Image& image, const Work& work);

}  // namespace palpable::vision
