// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace palpable::vision {

enum class ContourMethod {
  /// Gaussian derivatives over three scales, all channels, averaged as a structure tensor (docs/contours.md).
  standard,
  /// The paper's own (GHD 2006, section 3.2): Sobel, Otsu's threshold, Climent's masks in their octants.
  paper
};

struct ContourOptions {
  ContourMethod method = ContourMethod::standard;
  /// Radius m of the neighbourhood that eq. 7 averages over, 1 ... 32 px. Adjustable live on the page.
  double neighbourhood_px = 3.0;
  /// Strength (0 ... 1) from which a pixel is boundary; below 0 = by Otsu's method.
  double threshold = -1.0;
};

/// The boundaries of a picture as a density of edge vectors, in image axes (x right, y down). Directions have
/// no sign.
struct Contours {
  /// Unit tangent (zero where there is no structure at all) and strength 0 ... 1 of the edge vectors e.
  Raster<float> tangent_x;
  Raster<float> tangent_y;
  Raster<float> strength;
  /// One-pixel-wide boundaries: the strength on ridges that belong to a line reaching the threshold; 0
  /// elsewhere.
  Raster<float> line;
  double threshold = 0.0;
  /// Share of pixels at or above the threshold.
  double boundary_fraction = 0.0;
  std::vector<std::string> notes;
};

/// Extracts the boundaries of a picture with the same settings for every picture. Errors: invalid_input for
/// pictures under 8 x 8 or with a sample that is not finite, usage for options out of range, interrupted.
Result<Contours> find_contours(const Image& image, const ContourOptions& options, const Work& work);

/// Eq. 7: b = sum n(r) e / sum n(r), with n falling linearly from 1 at r = 0 to 0 at r = m = radius_px, over
/// doubled angles, so that the two sides of a thin line add up where vectors would cancel. Replaces tangents
/// and strength.
void average_neighbourhood(Raster<float>& tangent_x, Raster<float>& tangent_y, Raster<float>& strength,
                           double radius_px, const Work& work);

}  // namespace palpable::vision
