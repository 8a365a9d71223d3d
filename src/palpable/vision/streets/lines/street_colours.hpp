// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/streets/colours/map_colours.hpp"
#include "palpable/vision/streets/lines/arrows.hpp"
#include "palpable/vision/streets/lines/carriageways.hpp"
#include "palpable/vision/streets/lines/casings.hpp"
#include "palpable/vision/streets/lines/centre_lines.hpp"
#include "palpable/vision/streets/lines/even_ribbons.hpp"
#include "palpable/vision/streets/lines/hidden_sides.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

/// What the areas of one colour are.
enum class MapLayer : std::uint8_t { land, street, building, water, green };

struct StreetColourOptions {
  /// A colour is one of streets if at least this part of its area lies in ribbons: long strips of nearly
  /// constant width. 0 ... 1.
  double least_ribbon_part = 0.45;
  /// Tunnels are drawn in a paler colour of their streets: between these parts of the way from it to white,
  /// or from white to the land's colour, 0 ... 1 each, with at most this difference, levels, 0 ... 128.
  double least_paler = 0.3;
  double most_paler = 0.8;
  double paler_tolerance = 5.0;
  /// Such a colour needs only this part of its area in ribbons, 0 ... 1, and its tunnels are the lines that
  /// have casings, dashed ones as well, on this part of both sides, 0 ... 1, and are longer than this many
  /// widths, 0 ... 100.
  double tunnel_ribbon_part = 0.15;
  double tunnel_side_part = 0.3;
  double tunnel_widths = 1.5;
  /// A ribbon is longer than this many times its width. 0 ... 100.
  double least_length_widths = 4.0;
  /// The same of one between two junctions. 0 ... 100.
  double least_block_widths = 1.5;
  /// Largest standard deviation of a ribbon's width, as a part of the width. 0 ... 2.
  double most_width_spread = 0.3;
  /// Greatest width of a street, as a part of the picture's shorter side. 0 ... 1.
  double most_width_part = 0.05;
  /// Ribbons of less total length are no streets, as a part of the picture's shorter side. 0 ... 10.
  double least_total_part = 0.1;
  /// The same in their widths. 0 ... 1000.
  double least_total_widths = 18.0;
  /// Holes in streets up to this area are symbols, pixels. 0 ... 100 000.
  int hole_px = 150;
  /// A centre line of which the picture shows less than this part (the rest is under lettering or borders) is
  /// none. 0 ... 1.
  double least_seen_part = 0.35;
  /// A street of at least this radius is seen only where it is an area: the pale rims of a border are thin
  /// lines. Pixels, 0 ... 50.
  double broad_radius_px = 2.0;
  /// Points of a line on both sides of one of them that tell its direction. 1 ... 20.
  int direction_points = 3;
  /// Water is bluer than red by this much, compared with the land, and not greener than blue by more than
  /// `least_green`; vegetation is greener than its other channels by that much. Levels, 1 ... 255 each.
  int least_blue = 24;
  int least_green = 12;
  /// A colour is one of buildings if at least this many of its pieces have at least this area, pixels, and
  /// none of them covers this part of the picture. 1 ... 10 000, 1 ... 100 000, 0 ... 1.
  int fewest_buildings = 4;
  int least_building_px = 24;
  double most_building_part = 0.05;
  CentreLineOptions lines;
  CarriagewayOptions carriageways;
  ArrowOptions arrows;
  CasingOptions casings;
  HiddenSideOptions hidden_sides;
  EvenRibbonOptions even_ribbons;
};
std::vector<Parameter> parameters_of(StreetColourOptions& options);

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
