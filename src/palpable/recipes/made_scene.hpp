// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/models/scene/scene.hpp"

#include <vector>

namespace palpable::recipes {

/// The result of every recipe. scene.source.method names the recipe and its method; the caller fills in
/// where the values came from (scene.source.inputs and made_by).
struct MadeScene {
  models::Scene scene;
  /// Notes for the person about the input or the result.
  std::vector<Note> notes;
};

}  // namespace palpable::recipes
