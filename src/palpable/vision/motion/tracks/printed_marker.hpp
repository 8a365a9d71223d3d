// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/vision/motion/tracks/point_tracks.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace palpable::vision {

/// A square that is printed and laid beside a model, so that the scale of a video is known. It is a marker of
/// ArUco's original dictionary (Garrido-Jurado et al. 2014). The number in its code is the length of the
/// black square's side in millimetres.
inline constexpr std::array<int, 8> kMarkerSides_mm{30, 40, 50, 60, 80, 100, 120, 150};
/// Cells on a side of the black square: a border of one cell around 5 x 5 cells of code.
inline constexpr int kMarkerCells = 7;

/// The cells of the marker with this side: 1 = white, 0 = black. `side_mm` is one of kMarkerSides_mm.
Raster<std::uint8_t> marker_cells(int side_mm);

struct MarkerOptions {
  /// Least side of a marker in the picture, px, 14 … 200.
  double least_side_px = 18.0;
  /// Dark is what is darker than the mean of a window by this much, grey levels, 0 … 100. The sides of the
  /// three windows are these shares of the picture's longer side, each 0.005 … 1.
  double darker = 7.0;
  std::array<double, 3> window_shares{1.0 / 40, 1.0 / 16, 1.0 / 6};
  /// Greatest distance of a dark region's outline from its four sides, share of the outline, 0.001 … 0.2.
  double outline_error = 0.03;
  /// The brightness of a cell is that of its inner part, without this share on each side, 0 … 0.45.
  double cell_rim = 0.25;
  /// An edge of the square is looked for this far on both sides, in cells, 0.1 … 1, at this many places of
  /// each side, 4 … 200, which begin at this share of the side from its ends, 0 … 0.4.
  double edge_reach = 0.7;
  int edge_places = 25;
  double edge_margin = 0.12;
  /// From black to white it rises by at least this much, grey levels, 1 … 255. At least half of the places
  /// must have one.
  double least_rise = 25.0;
  /// Least sine of the angle between two neighbouring sides, 0.01 … 1.
  double least_corner_sine = 0.1;
  /// At most this many frames are searched, evenly spaced, 2 … 1000.
  int most_frames = 40;
  /// A corner that is farther from where its point is projected is not used, px, 0.1 … 20.
  double outlier_px = 2.5;
  /// Where the sides of the square differ by more than this share, its scale is not used, 0.005 … 0.5.
  double most_difference = 0.04;
};
std::vector<Parameter> parameters_of(MarkerOptions& options);

/// A marker in a picture.
struct SeenMarker {
  int side_mm = 0;
  /// The corners of the black square, clockwise, from the upper left one of the printed sheet.
  std::array<ImagePoint, 4> corners;
};

/// The markers that a picture shows completely: dark quadrilaterals whose cells are one of the codes without
/// an error. `grey`: 8-bit grey levels.
std::vector<SeenMarker> find_markers(const Raster<std::uint8_t>& grey, const MarkerOptions& options);

}  // namespace palpable::vision
