// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/contours/contour_options.hpp"

// Inside vision's sources only: the three methods of find_contours() before thresholding.
namespace palpable::vision {

/// Edge vectors of every pixel.
struct EdgeResponse {
  /// Undirected unit tangents in image axes; zero where there is no structure.
  Raster<float> tangent_x;
  Raster<float> tangent_y;
  /// 0 … 1.
  Raster<float> strength;
  /// Weight of the finest scale, 0.05 … 1: small in speckle and grain, whose energy is everywhere.
  float fine_trust = 1.0F;
  /// Lower bound of Otsu's threshold in this picture.
  float least_threshold = 0.0F;
};

/// Our own method: see docs/contours.md. Direction from the structure tensor of Gaussian derivatives of scale
/// 2 px; strength from the energy (first and second derivative) of scales 1, 2, 4 and 8 px together, less
/// that of the texture around; in grain also from the distinctness of both sides at 8, 16 and 32 px.
EdgeResponse standard_edges(const Image& image, const ContourOptions& options, const Work& work);

/// Two boxes side by side at each pixel, in several directions and sizes; strength is the difference of their
/// means over their standard deviation, which is robust to speckle and grain. The clearer the picture
/// (fine_trust), the more the standard method counts instead. Empty if cancelled.
EdgeResponse best_edges(const Image& image, const ContourOptions& options, const Work& work);

/// The paper's (3.2): Sobel's magnitude, and Climent's direction within their octants. Grey only.
EdgeResponse paper_edges(const Image& image, const Work& work);

}  // namespace palpable::vision
