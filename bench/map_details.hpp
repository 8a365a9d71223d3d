// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "drawn_maps.hpp"
#include <cairo/cairo.h>

// What maps show besides streets, buildings and names of streets; drawing that the map's parts share.
namespace palpable::bench {

/// A way with its points in the picture.
struct ProjectedWay {
  const sources::ExtractWay* way;
  std::vector<MapPoint> points;
};

void set_colour(cairo_t* cr, Rgb8 c);
void add_path(cairo_t* cr, const std::vector<MapPoint>& points);
void stroke(cairo_t* cr, const std::vector<MapPoint>& points, Rgb8 colour, double width,
            const std::vector<double>& dashes = {});

/// `part` of the second colour in the first, 0 ... 1.
Rgb8 mixed(Rgb8 a, Rgb8 b, double part);

/// The length of a line, pixels.
double length_of(const std::vector<MapPoint>& line);

/// Areas of housing, shops and schools, car parks and squares, under everything else.
void draw_areas_of_use(cairo_t* cr, const DrawnMapStyle& style, int side, std::mt19937_64& random);

/// Borders, bridges, arrows of one-way streets, bus stops, symbols and their labels. Returns the places where
/// no names may be.
std::vector<TakenPlace> draw_symbols(cairo_t* cr, const std::vector<ProjectedWay>& ways,
                                     const DrawnMapStyle& style, int side, std::mt19937_64& random);

}  // namespace palpable::bench
