// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/camera.hpp"
#include "palpable/core/image.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/session/make/make_scene.hpp"
#include "palpable/sources/depth/depth_picture.hpp"
#include "palpable/vision/segmentation/ground.hpp"

#include <string>
#include <vector>

namespace palpable::session {

/// What ground and background are found in: a picture, and where the depth of its pixels is from.
struct SeenPicture {
  Raster<Rgb8> picture;
  vision::DisparityOrigin origin = vision::DisparityOrigin::matched;
};

/// Whether the ground or the background is to be found at all.
bool asks_for_regions(const MakeOptions& options);

/// The disparity with ground and background treated as the options say. The scene's labels and materials say
/// where they are (left empty where neither was found); notes say how much they cover, or that there is none.
DisparityMap with_regions_treated(const DisparityMap& disparity, const SeenPicture& seen,
                                  const MakeOptions& options, const Work& work, models::Scene& scene,
                                  std::vector<std::string>& notes);

/// Likewise for depth that was not matched, which is looked at as a pair of cameras would see it. As it was
/// where neither is found; a flattened ground leaves heights above it, which are no depths any more.
void treat_regions(sources::DepthPicture& read, const MakeOptions& options, const Work& work,
                   models::Scene& regions);

}  // namespace palpable::session
