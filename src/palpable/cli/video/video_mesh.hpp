// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/recipes/video/video_recipe.hpp"

#include <cstddef>
#include <vector>

namespace palpable::cli {

/// The surface of a video's field as GLB, with parts of the video's frames as its texture. Errors: as
/// sculpt::surface_of_field() and formats::encode_glb().
Result<std::vector<std::byte>> video_glb(const recipes::VideoReconstruction& video,
                                         const models::Scene& scene, const Work& work);

}  // namespace palpable::cli
