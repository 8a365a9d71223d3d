// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/motion/depth/multi_view_depth.hpp"

#include <span>
#include <vector>

namespace palpable::vision {

struct FillingOptions {
  /// Depths that other maps give a pixel agree if they differ by less than this share, 0.0005 … 0.1.
  double tolerance = 0.01;
};
std::vector<Parameter> parameters_of(FillingOptions& options);

/// Fills the unknown pixels of each map with what the other maps measured there, such as surfaces that were
/// occluded in the frames with which this one was compared: with the surface that most maps agree on, of
/// several the nearest. Known pixels stay; pixels that no other map shows stay unknown. Errors: usage for
/// options out of range; interrupted.
Result<std::vector<PosedDepthMap>> filled_depth(std::span<const PosedDepthMap> maps,
                                                const FillingOptions& options, const Work& work);

}  // namespace palpable::vision
