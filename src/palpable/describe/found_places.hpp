// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/named_place.hpp"
#include "palpable/models/scene/scene.hpp"

#include <optional>
#include <vector>

namespace palpable::describe {

/// What the program found in a scene that a person may name: streets and places of a map, regions, lines,
/// bodies of a solid, hills of a relief. `labels`: reduced_labels() of the scene's.
std::vector<NamedPlace> found_places(const models::Scene& scene, const Raster<std::uint8_t>& labels);

/// Every n-th sample of an image of labels, at most `longest_side` along the longer side.
Raster<std::uint8_t> reduced_labels(const Raster<std::uint8_t>& labels, int longest_side);

/// The place nearest to `from` where there is something to touch: of a solid, its surface as seen from above;
/// of lines, a line; of a map, a street that is felt; of others `from` itself. nullopt if there is none.
std::optional<Place> nearest_surface(const models::Scene& scene, Place from);

/// Where a touch begins: the middle, or the surface nearest to it.
Place start_place(const models::Scene& scene);

}  // namespace palpable::describe
