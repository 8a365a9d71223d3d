// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/result.hpp"
#include "palpable/formats/packing/zip.hpp"

#include <cstddef>
#include <span>

#include <nlohmann/json_fwd.hpp>

namespace palpable::formats {

/// The map as `palpable info` prints it and as it is stored: width_px, height_px, streets, crossings,
/// buildings, waters, greens, labels (docs/maps.md). Positions are rounded to 1/100 pixel.
nlohmann::json json_of(const StreetMap& map);

/// A scene's member "map.json".
Bytes encode_street_map(const StreetMap& map);

/// Reads it. Errors: invalid_input for damaged text, a street without two points, numbers that are not
/// finite, or more than 100 000 streets or areas.
Result<StreetMap> decode_street_map(std::span<const std::byte> file);

}  // namespace palpable::formats
