// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/video/video_recipe.hpp"
#include "palpable/vision/motion/tracks/point_tracks.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace palpable::recipes {

struct VideoTracks {
  std::vector<vision::PointTrack> tracks;
  /// Whether points were followed from frame to frame, as in a video, whose frames were taken at equal times;
  /// else they were matched.
  bool are_followed = true;
};

/// Whether most pictures share enough points with both of the next two: the pose of a picture follows from
/// points that the two before it determine. At least two pictures.
bool are_followed(std::span<const vision::PointTrack> tracks, int pictures, const VideoRecipe& recipe);

/// Finds points of the scene in the pictures, 8-bit grey and all of one size: they are followed from one to
/// the next (vision::track_points()). Where two neighbours share too few points, such as after a jerk, points
/// around the gap are matched too; if they are not followed (are_followed()), all pictures are matched
/// instead (vision::match_photos()). Long work: reports progress, polls cancel. Errors: those of these
/// functions.
Result<VideoTracks> tracks_of_video(std::span<const Raster<std::uint8_t>> pictures, const VideoRecipe& recipe,
                                    const Work& work);

}  // namespace palpable::recipes
