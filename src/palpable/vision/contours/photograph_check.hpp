// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"

#include <string>
#include <vector>

namespace palpable::vision {

/// When a picture gets a warning that its boundaries cannot be trusted.
struct PhotographCheckOptions {
  /// A picture whose brightest parts are below this level is dark. 0 … 1.
  double dark_level = 0.3;
  /// A picture whose levels span less than this has little contrast. 0 … 1.
  double least_contrast = 0.15;
  /// Greatest noise as a share of the contrast. 0 … 1.
  double most_noise = 0.1;
  /// Greatest width of the steepest edges, as a share of the picture's longer side. 0 … 1.
  double most_blur = 0.015;
};
std::vector<Parameter> parameters_of(PhotographCheckOptions& options);

/// What in a photograph spoils its boundaries.
struct PhotographQuality {
  /// The greatest level, and its distance to the least one, after a Gaussian of one pixel's deviation, so
  /// that neither noise nor thin lines decide. 0 … 1.
  double brightness = 0.0;
  double contrast = 0.0;
  /// Standard deviation of the noise, as a level 0 … 1 (the median form of Immerkær 1996).
  double noise = 0.0;
  /// Median width of the steepest edges, from their dark to their bright side, as a share of the longer side.
  /// 0 where there is no edge.
  double blur = 0.0;
};

/// Measures a picture of at least 8 x 8 pixels with finite samples. Any thread.
PhotographQuality photograph_quality(const Image& image);

/// One sentence for a layperson: what is wrong with the figures, and what to do. Empty for a good picture.
/// The options are in their ranges.
std::string photograph_verdict(const PhotographQuality& quality, const PhotographCheckOptions& options = {});

}  // namespace palpable::vision
