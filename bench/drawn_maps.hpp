// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/sources/map/map_extract.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// Street maps drawn from extracts in several styles, with their exact truth.
namespace palpable::bench {

/// How a kind of street is drawn.
struct StreetPaint {
  Rgb8 fill{255, 255, 255};
  Rgb8 casing{180, 180, 180};
  double width_px = 8.0;
  /// 0: none.
  double casing_px = 1.0;
};

/// How a map is drawn; sizes hold for one pixel a metre.
struct DrawnMapStyle {
  std::string name;
  /// Widths of streets and sizes of letters grow with these powers of the scale (pixels a metre).
  double width_power = 0.5;
  double font_power = 0.0;
  /// A pixel is this many times as many metres as the window says.
  double zoom_out = 1.0;
  Rgb8 land{242, 239, 233};
  Rgb8 building{217, 208, 201};
  Rgb8 building_line{190, 180, 170};
  bool buildings = true;
  Rgb8 water{170, 211, 223};
  Rgb8 green{200, 235, 180};
  StreetPaint major, middle, minor, service, pedestrian;
  /// Drawn like major (motorways, trunk roads) and middle ones if not given.
  std::optional<StreetPaint> motorway, trunk, tertiary;
  /// How much of the land's colour is mixed into white streets in tunnels, and of white into coloured ones, 0
  /// ... 1.
  double tunnel_fade = 0.0;
  /// What maps show besides: areas of use, squares, car parks, trees, symbols and their labels, arrows of
  /// one-way streets, bridges, borders.
  bool details = false;
  Rgb8 path{240, 140, 120};
  Rgb8 track{170, 120, 40};
  Rgb8 rail{120, 120, 120};
  std::string font = "DejaVu Sans Condensed";
  double font_px = 11.0;
  Rgb8 ink{0, 0, 0};
  Rgb8 halo{255, 255, 255};
  double halo_px = 0.0;
  /// Halos have the colour of the street below.
  bool halo_of_street = false;
  /// Distance between repeated names, pixels.
  double repeat_px = 450.0;
  bool capitals = false;
  /// The picture is turned by up to this angle, degrees, as a scan is.
  double skew_deg = 0.0;
  /// Standard deviation of the noise, grey levels, and of the blur, pixels.
  double noise = 0.0;
  double blur_px = 0.0;
  /// 0: not compressed.
  int jpeg_quality = 0;
};

/// The styles, from clean drawings to scans.
std::vector<DrawnMapStyle> drawn_map_styles();

/// The true line of a way in the picture.
struct DrawnWay {
  std::string kind;
  std::string name;
  std::vector<MapPoint> points;
  /// As it is drawn, with its casing.
  double width_px = 0.0;
  bool tunnel = false;
};

/// A name that is drawn whole: the middle of its letters, in the reading direction.
struct DrawnName {
  std::string text;
  std::vector<MapPoint> line;
};

/// Where no name is written, and how far away the middles of the letters stay, in sizes of the font.
struct TakenPlace {
  MapPoint at;
  double letters = 1.7;
};

struct DrawnMap {
  Raster<Rgb8> picture;
  std::vector<DrawnWay> ways;
  std::vector<DrawnName> lettering;
};

/// Where and how large: metres of one pixel.
struct DrawnWindow {
  sources::GeoPoint center;
  double metres_per_px = 1.2;
  int side_px = 900;
};

DrawnMap drawn_map(const sources::MapExtract& extract, const DrawnWindow& window, const DrawnMapStyle& style,
                   std::uint64_t seed);

/// How a kind of street is drawn.
const StreetPaint& paint_of(const std::string& kind, const DrawnMapStyle& style);

/// A town that is not real: streets of several kinds, among them dual carriageways, bent and dead-end ones,
/// tracks, paths, tunnels, ponds, parks and buildings, around 0,0. For where there are no extracts.
sources::MapExtract drawn_town(std::uint64_t seed);

}  // namespace palpable::bench
