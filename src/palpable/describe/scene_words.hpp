// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/place_words.hpp"

#include <string>
#include <vector>

namespace palpable::describe {

/// The name of a scene: its title, else the names of its source files, else its kind.
std::string name_of(const models::Scene& scene);

/// Spoken before a touch begins: the name, the maker's description, and what of the scene cannot be trusted.
std::string opening_words(const models::Scene& scene);

/// The description of a scene in parts, from short to long; the user requests them one after another.
///   - Name and size. Then the number and places of the objects above the ground (peaks.hpp) or of the lines
///   (contour_words.hpp); of a solid its parts, openings and outline (solid_words.hpp). Then the scene's
///   warnings.
///   - The maker's description, if there is one.
///   - Each object or line with place and size, and the offset from `probe` to the highest point or nearest
///   line.
///   - For a surface, the average heights of its nine parts. A level scene has only the first two.
/// `height_factor`: as in place_words.hpp. Takes some milliseconds.
std::vector<std::string> scene_parts(const models::Scene& scene, double height_factor, Place probe);

/// What the D key says when it is pressed for the time `part`, counted from 0: the parts one after another.
/// Each ends by saying whether there is more. After the last one they are repeated, without these words.
std::string scene_part(const models::Scene& scene, double height_factor, Place probe, std::size_t part);

}  // namespace palpable::describe
