// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/made_scene.hpp"
#include "palpable/sculpt/contours/boundary_map_from_picture.hpp"
#include "palpable/sculpt/contours/grooves.hpp"
#include "palpable/vision/contours/contours.hpp"
#include "palpable/vision/contours/photograph_check.hpp"

#include <cstddef>

namespace palpable::recipes {

/// How a picture becomes a map of its boundaries.
struct ContoursRecipe {
  vision::ContourOptions contours;
  vision::PhotographCheckOptions photograph;
  sculpt::BoundaryMapOptions map;
  sculpt::GrooveOptions grooves;
  /// Larger pictures are reduced to this number of pixels: 2000 pixels over the width of a hand are finer
  /// than touch.
  std::size_t most_pixels = std::size_t{4} << 20U;
};

/// The boundaries of one picture, as a map to trace and as grooves. Long work: reports progress, polls
/// cancel. Any thread. The scene warns of a picture without lines, or too dark, noisy or blurred to trust
/// them. Errors: as vision::find_contours(), sculpt::boundary_map_from_contours() and
/// sculpt::grooves_from_boundary_map(), without a place.
Result<MadeScene> contours_from_picture(Image picture, const ContoursRecipe& recipe, const Work& work);

}  // namespace palpable::recipes
