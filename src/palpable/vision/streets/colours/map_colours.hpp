// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/vision/streets/colours/map_frame.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

struct MapColourOptions {
  MapFrameOptions frame;
  /// Largest difference, in one channel, between a pixel and its colour in a clean picture, levels. 1 ...
  /// 128.
  double tolerance = 8.0;
  /// Scans and lossy copies widen it by this many times their noise, the median difference of neighbours. 0
  /// ... 10.
  double noise_tolerance = 2.0;
  /// Neighbouring pixels that differ by more than this, levels, lie at an edge and tell nothing about noise.
  /// 1
  /// ... 255.
  int least_edge = 32;
  /// A picture is noisy if at least this part of the neighbouring pixels differs, 0 ... 1, half of these by
  /// at most this much, levels, 0 ... 255.
  double noisy_part = 0.28;
  int most_noise = 10;
  /// It is smoothed first, without its edges (Tomasi & Manduchi 1998): the greatest difference that counts as
  /// noise, summed over the channels, levels, 1 ... 765; the reach, pixels, 0.5 ... 10; how often, 1 ... 10.
  double noise_difference = 24.0;
  double noise_reach_px = 1.5;
  int noise_rounds = 2;
  /// A picture without noise is a drawing that was never compressed with loss if of the neighbouring pixels
  /// that differ, at most this part does by one or two levels. 0 ... 1.
  double lossy_part = 0.25;
  /// In such a drawing, colours that differ by more than this in one channel are two: a tunnel's pale fill
  /// and the land. Levels, 1 ... 128.
  int least_apart = 5;
  /// A colour that fills less than this part of the picture is not an area of the map. 0.00001 ... 0.5.
  double least_part = 0.0005;
  /// Most colours that are distinguished. 2 ... 64.
  int most_colours = 40;
  /// Lines that are thinner than this are lettering and borders, pixels. 1 ... 20.
  int thinnest_px = 3;
  /// A colour of which a smaller part than this is thicker is that of ink. 0 ... 1.
  double least_thick_part = 0.1;
  /// Thinner lines of an area's colour that are at least this long are narrow streets, pixels. 1 ... 1000.
  double thin_length_px = 24.0;
  /// A colour whose largest piece is smaller than this part of the picture is one of symbols. 0 ... 0.5.
  double symbol_part = 0.0004;
};
std::vector<Parameter> parameters_of(MapColourOptions& options);

/// A colour that the map uses for areas.
struct MapColour {
  Rgb8 value;
  /// Number of its pixels.
  int pixels = 0;
};

/// The map without its lettering and borders: each pixel has the colour of the area in which it lies.
struct MapColours {
  /// The picture without noise.
  Raster<Rgb8> picture;
  /// Which part of it is the map.
  MapFrame frame;
  static constexpr std::uint8_t kNone = 255;
  std::vector<MapColour> colours;
  /// The colour outside of the frame, the last of them, of zero pixels; kNone if the map fills the picture.
  std::uint8_t page = kNone;
  /// Index of the colour of each pixel.
  Raster<std::uint8_t> of_pixel;
  /// Where the picture itself shows that colour, and how; elsewhere it is 0 and the colour is that of the
  /// nearest such pixel.
  static constexpr std::uint8_t kThinLine = 1;
  static constexpr std::uint8_t kArea = 2;
  Raster<std::uint8_t> seen;
};

/// The flat colours of a map picture: peaks of its histogram, learned from the picture. A picture without
/// flat colours has none. Any thread.
MapColours find_map_colours(const Raster<Rgb8>& picture, const MapColourOptions& options = {});

}  // namespace palpable::vision
