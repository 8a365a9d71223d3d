// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/place_words.hpp"

#include <string>
#include <vector>

namespace palpable::describe {

/// What a scene is called: its title, else the names of the files that it was made from, else its kind.
std::string name_of(const models::Scene& scene);

/// What is said before a touch begins: the name and the maker's description.
std::string opening_words(const models::Scene& scene);

/// The description of a scene in parts, from short to long; a person asks for one after the other.
///   - Name, size, and how many objects rise above the ground (peaks.hpp), how many lines there are
///     (contour_words.hpp), or a solid's outline, parts and openings (solid_words.hpp), with where they are.
///   - The maker's description, where there is one.
///   - Each object or line with place and size, and the way from `probe` to the highest point or nearest
///   line.
///   - Of a surface, the average heights of its nine parts.
/// Of a level scene only the first two. `depth`: as in place_words.hpp. Takes some milliseconds.
std::vector<std::string> scene_parts(const models::Scene& scene, double depth, Place probe);

/// One of the parts, counted on: after the last one comes the first. Every part but the last says that there
/// is more.
std::string scene_part(const models::Scene& scene, double depth, Place probe, std::size_t part);

}  // namespace palpable::describe
