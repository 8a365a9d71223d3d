// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/core/result.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/recipes/video/video_recipe.hpp"

#include <string>
#include <vector>

namespace palpable::cli {

/// One HTML page about the scene of a video, for people without technical knowledge: what to do better, some
/// frames, the camera's path, depth, the model, and figures (draw::html_of()). `name`: the video's.
/// Errors: failed if a picture cannot be drawn.
Result<std::string> video_report(const std::string& name, const recipes::VideoReconstruction& video,
                                 const models::Scene& scene, const std::vector<Note>& notes);

}  // namespace palpable::cli
