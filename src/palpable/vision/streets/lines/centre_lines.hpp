// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

/// A piece of a centre line between two nodes.
struct CentreLine {
  /// From node `first` to node `last`, about one point a pixel.
  std::vector<MapPoint> points;
  int first = 0;
  int last = 0;
  /// Mean distance from the line to the mask's border, pixels, and its standard deviation along the line.
  double radius_px = 0.0;
  double radius_spread_px = 0.0;
  MapStreet::Kind kind = MapStreet::Kind::street;
};

/// The lines in the middle of a mask, as a graph.
struct CentreLines {
  std::vector<MapPoint> nodes;
  std::vector<CentreLine> lines;
};

/// How many lines end at each node.
std::vector<int> degrees_of(const CentreLines& graph);

/// What is known of a mask's lines before it is thinned, of the mask's size, or empty: pixels of lines
/// (`kept`) and those inside it that have none.
struct ThinningGuide {
  Raster<std::uint8_t> kept;
  Raster<std::uint8_t> outside;
};

struct CentreLineOptions {
  /// A branch that ends freely and is shorter than this many times its radius, and this, pixels, comes from
  /// the mask's border (that of a square corner is sqrt(2) radii long). 0 ... 10 and 0 ... 50.
  double spur_radii = 1.6;
  double spur_px = 2.0;
  /// The width of a line of more points than the second is measured without this part of it at each end,
  /// which lies in a junction. 0 ... 0.4 and 0 ... 1000.
  double end_part = 1.0 / 6.0;
  int least_points = 12;
};
std::vector<Parameter> parameters_of(CentreLineOptions& options);

/// Thins the set pixels of a mask to lines (Zhang & Suen 1984) and traces them. Branches that are shorter
/// than the mask is wide there come from its border and are removed. Any thread.
CentreLines centre_lines_of(const Raster<std::uint8_t>& mask, const ThinningGuide& guide = {},
                            const CentreLineOptions& options = {});

/// Length of a line, pixels.
double length_px(const std::vector<MapPoint>& points);

/// Removes leaves shorter than `radii` times their radius plus `more_px` pixels, and joins lines at nodes
/// where only two remain. Isolated lines are kept.
void remove_spurs(CentreLines& graph, double radii, double more_px);

/// Removes connected lines whose total length is below `least_px`, or below `least_radii` times a line's
/// radius.
void remove_short_networks(CentreLines& graph, double least_px, double least_radii);

/// Joins the two lines of each node that has only two, if they are of one kind.
void join_lines(CentreLines& graph);

/// Divides a line at one of its points; returns the node there, which is one of its own at an end.
int split_line(CentreLines& graph, std::size_t number, std::size_t at);

/// Adds a straight line between two nodes.
void connect_nodes(CentreLines& graph, int a, int b, double radius_px);

/// The points as a moving mean over 2 * reach + 1 of them; the ends stay.
std::vector<MapPoint> smoothed(const std::vector<MapPoint>& points, int reach);

/// Fewer points, none of the left-out ones farther than `most_px` from the line (Douglas & Peucker 1973).
std::vector<MapPoint> simplified(const std::vector<MapPoint>& points, double most_px);

}  // namespace palpable::vision
