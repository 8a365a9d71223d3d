// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace palpable::vision {

struct UsableFrameOptions {
  /// A frame whose sharpness is below this share of the median sharpness of the frames around it is left out,
  /// 0 (none) … 1.
  double least_sharpness = 0.35;
  /// That many frames before and after it are compared, 1 … 60.
  int compared_frames = 8;
  /// A frame that differs from the last one kept by less, in mean grey levels of 255, is a copy of it and
  /// left out, 0 (none) … 10.
  double least_change = 0.25;
};
std::vector<Parameter> parameters_of(UsableFrameOptions& options);

/// The frames that a video's motion is computed from.
struct UsableFrames {
  /// Indices of the frames that are kept, ascending; never empty unless there were no frames.
  std::vector<int> kept;
  int blurred = 0;
  int copies = 0;
  /// Frames that are kept, since those around them are no better, but that the sharpest tenth of all frames
  /// exceeds as far as a frame that is left out.
  int soft = 0;
  /// Median of edge_width_px() over the frames that are kept; 0 without frames.
  double edge_width_px = 0.0;
};

/// How many pixels the strongest edges of a picture are wide, 1 … 8, in the direction in which they are
/// wider: the difference of grey levels across 8 px as a multiple of that across one, each exceeded by one of
/// 200 places. About 2 for a sharp picture; a blur that extends over 8 px or more cannot be told from one
/// of 8. 1 for a picture without edges. Unlike other measures it does not need a sharp frame to compare with.
double edge_width_px(const Raster<std::uint8_t>& frame);

/// Leaves out blurred frames and copies. Sharpness is the variance of the Laplacian (Pech-Pacheco et al.
/// 2000) over that of the grey levels. Frames are 8-bit grey, all of one size. Polls cancel. Errors: usage
/// for options out of range; interrupted.
Result<UsableFrames> usable_frames(std::span<const Raster<std::uint8_t>> frames,
                                   const UsableFrameOptions& options, const Work& work);

}  // namespace palpable::vision
