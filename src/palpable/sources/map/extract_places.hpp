// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/sources/map/extract_window.hpp"
#include "palpable/sources/map/projection.hpp"

namespace palpable::sources {

/// Adds the special places of an extract that lie in the window of a map, whose streets and areas are known:
/// special buildings, roundabouts, and the places of the layers. The outline of a building that has none is
/// that of the map's building around it.
void add_places(StreetMap& map, const MapExtract& extract, const ExtractLayers& layers,
                const Projection& project);

}  // namespace palpable::sources
