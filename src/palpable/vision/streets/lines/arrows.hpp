// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/vision/streets/lines/centre_lines.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace palpable::vision {

struct ArrowOptions {
  /// An arrow is darker than its street by at least this much, grey levels. 1 ... 255.
  double least_contrast = 70.0;
  /// It is this far inside of the street's border, pixels. 0 ... 20.
  double inside_px = 2.0;
  /// Its length and its least area, pixels. 1 ... 100 each.
  double shortest_px = 6.0;
  double longest_px = 22.0;
  int least_area_px = 8;
  /// It is at least this many times as long as it is wide (standard deviations of its pixels). 1 ... 10.
  double least_elongation = 1.8;
  /// Nothing else dark is nearer than this many of its lengths: letters have neighbours. 0 ... 10.
  double apart_lengths = 1.2;
  /// Beside the middle of its street's area it shows one of two carriageways: at least this far, pixels, 0
  /// ... 50, and this part of the area's radius, 0 ... 1.
  double least_aside_px = 2.5;
  double least_aside = 0.3;
  /// And at most this part of it. 0 ... 1.
  double most_aside = 0.6;
  /// Its direction is at most this far from the street's, degrees, 0 ... 90, which is measured over this many
  /// points on both sides, 1 ... 50.
  double angle_deg = 25.0;
  int direction_points = 5;
  /// Radii of carriageways that differ by less than this part are the same. 0 ... 1.
  double same_radius = 0.12;
  /// So many such arrows decide for one street (or one, whose distances from the area's middle and border are
  /// together its radius), and so many for all streets of a colour, of which they are at least this part. 1
  /// ... 100, 1 ... 1000 and 0 ... 1.
  int fewest_of_street = 2;
  int fewest_of_colour = 3;
  double common_part = 0.2;
};
std::vector<Parameter> parameters_of(ArrowOptions& options);

/// The middle of an arrow and the direction of its shaft, a unit vector of either sign.
struct Arrow {
  MapPoint at;
  MapPoint along;
};

/// The arrows of one-way streets in the streets of one colour: `mask` is theirs, without holes. Any thread.
std::vector<Arrow> find_arrows(const Raster<Rgb8>& picture, const Raster<std::uint8_t>& mask, Rgb8 street,
                               const ArrowOptions& options = {});

/// Radius of a single carriageway of each line, pixels. Arrows lie in the middle of their carriageway: where
/// two are drawn as one area, an arrow is beside the area's middle, and its distance from the border is a
/// carriageway's radius. Lines without such arrows have the widest common one of the colour, or `otherwise`.
/// Any thread.
std::vector<double> radii_by_arrows(const Raster<std::uint8_t>& mask, const CentreLines& lines,
                                    std::span<const Arrow> arrows, double otherwise,
                                    const ArrowOptions& options = {});

}  // namespace palpable::vision
