// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/recipes/video/video_model.hpp"
#include "palpable/vision/motion/depth/video_depth.hpp"
#include "palpable/vision/segmentation/video_segments.hpp"

#include <vector>

namespace palpable::recipes {

/// The first superquadrics of Moustakas et al. 2007, from the segments of one picture alone: their position
/// and size across the line of sight are those of the segment, their distance is that of the scene (the
/// median of the map, which is the unit of the poses), and their thickness is the mean of their other sizes.
/// Segments at the picture's border are the ground. In the model's axes; may be empty. Errors: as
/// vision::VideoSegmenter::add().
Result<std::vector<models::Superquadric>> shapes_of_segments(const Raster<Rgb8>& picture,
                                                             const vision::FrameDepth& map,
                                                             const VideoModel& model,
                                                             const vision::VideoSegmentOptions& options);

}  // namespace palpable::recipes
