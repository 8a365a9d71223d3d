// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/streets/carriageways.hpp"
#include "palpable/vision/streets/casings.hpp"
#include "palpable/vision/streets/centre_lines.hpp"
#include "palpable/vision/streets/map_colours.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

/// What the areas of one colour are.
enum class MapLayer : std::uint8_t { land, street, building, water, green };

struct StreetColourOptions {
  /// A colour is one of streets if at least this part of its area lies in ribbons: long strips of nearly
  /// constant width.
  double least_ribbon_part = 0.45;
  /// A ribbon is longer than this many times its width.
  double least_length_widths = 4.0;
  /// The same of one between two junctions.
  double least_block_widths = 1.5;
  /// Largest standard deviation of a ribbon's width, as a part of the width.
  double most_width_spread = 0.3;
  /// Greatest width of a street, as a part of the picture's shorter side.
  double most_width_part = 0.05;
  /// Ribbons of less total length are no streets, as a part of the picture's shorter side.
  double least_total_part = 0.1;
  /// The same in their widths.
  double least_total_widths = 18.0;
  /// Holes in streets up to this area are symbols, pixels.
  int hole_px = 150;
  /// A centre line of which the picture shows less than this part (the rest is under lettering or borders) is
  /// none.
  double least_seen_part = 0.35;
  CarriagewayOptions carriageways;
  CasingOptions casings;
};

/// One colour's meaning, and its centre lines if it is one of streets.
struct LayerOfColour {
  MapLayer layer = MapLayer::land;
  /// Part of the colour's area in ribbons, 0 ... about 1.
  double ribbon_part = 0.0;
  CentreLines lines;
};

/// Decides by shape (streets are ribbons) and hue what each colour of a map is. Any thread.
std::vector<LayerOfColour> layers_of(const MapColours& colours, const StreetColourOptions& options = {});

}  // namespace palpable::vision
