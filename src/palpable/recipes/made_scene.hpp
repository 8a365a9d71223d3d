// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/models/scene/scene.hpp"

#include <vector>

namespace palpable::recipes {

/// What every recipe returns. scene.source.method names the recipe and its method; where the values came from
/// (scene.source.inputs and made_by) is for the caller to fill in.
struct MadeScene {
  models::Scene scene;
  /// What the person should know of the input or the result.
  std::vector<Note> notes;
};

}  // namespace palpable::recipes
