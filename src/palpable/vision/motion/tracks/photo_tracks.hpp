// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/motion/tracks/point_tracks.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace palpable::vision {

struct PhotoMatchOptions {
  /// Features of a picture, the strongest ones, 100 … 20 000.
  int most_features = 3000;
  /// A match is kept when its distance is below this share of that to the next best feature (Lowe 2004), 0.3
  /// … 1.
  double ratio = 0.8;
  /// Matches farther from the epipolar line are wrong, px, 0.2 … 20.
  double epipolar_px = 2.0;
  /// Two pictures are matched when so many matches agree with one epipolar geometry, 8 … 1000.
  int least_matches = 24;
  /// Each picture is matched with this many that follow it, 1 … 400.
  int following = 30;
};
std::vector<Parameter> parameters_of(PhotoMatchOptions& options);

/// Points of the scene in pictures that were taken far apart: SIFT features (Lowe 2004), mutual nearest
/// neighbours that pass the ratio test and one epipolar geometry for each two pictures (RANSAC), joined over
/// all pictures. Pictures are 8-bit grey, all of one size. Long work: all threads, reports progress, polls
/// cancel. Errors: usage for options out of range; interrupted.
Result<std::vector<PointTrack>> match_photos(std::span<const Raster<std::uint8_t>> pictures,
                                             const PhotoMatchOptions& options, const Work& work);

}  // namespace palpable::vision
