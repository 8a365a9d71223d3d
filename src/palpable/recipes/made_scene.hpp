// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/models/scene/scene.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace palpable::recipes {

struct VideoReconstruction;

/// The result of every recipe. scene.source.method names the recipe and its method; the caller fills in
/// where the values came from (scene.source.inputs and made_by).
struct MadeScene {
  models::Scene scene;
  /// Notes for the user about the input or the result.
  std::vector<Note> notes;
  /// Of a video: what was found on the way (video_recipe.hpp).
  std::shared_ptr<const VideoReconstruction> video = nullptr;
};

/// Adds a note that stays with the scene as one of its warnings.
inline void warn(MadeScene& made, Note note) {
  made.scene.warnings.push_back(note.sentence);
  made.notes.push_back(std::move(note));
}

}  // namespace palpable::recipes
