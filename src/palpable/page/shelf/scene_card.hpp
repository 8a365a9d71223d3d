// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/scene/scene.hpp"
#include "palpable/page/shelf/recent_scenes.hpp"

#include <string_view>

namespace palpable::page::shelf {

/// SceneCard::kind of those that can be saved as more, or fewer, files than others.
constexpr std::string_view kMapKind = "a street map", kGridKind = "a solid of cells";

/// What a shelf says of a scene: its name, what it is, and the first sentences of its description, or else
/// of what the program says about it. Takes some milliseconds.
SceneCard scene_card(const models::Scene& scene);

/// The picture of a scene from above, lit from the upper left, at most `longest_side` pixels wide and high.
/// Takes some milliseconds.
Raster<Rgb8> scene_picture(const models::Scene& scene, int longest_side);

}  // namespace palpable::page::shelf
