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
  /// Pairs of boxes in many directions and sizes (docs/contours.md): seconds, but sees through speckle.
  best,
  /// The paper's own (GHD 2006, section 3.2): Sobel, Otsu's threshold, Climent's masks in their octants.
  paper
};

struct ContourOptions {
  ContourMethod method = ContourMethod::standard;
  /// Strength (0 ... 1) from which a pixel is boundary; below 0 = by Otsu's method.
  double threshold = -1.0;
};

/// The boundaries of a picture as a density of edge vectors e, in image axes (x right, y down). Directions
/// have no sign.
struct Contours {
  /// Unit tangent (zero where there is no structure at all) and strength 0 ... 1; 0 below half the threshold.
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

}  // namespace palpable::vision
