// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/names/stacked_lettering.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace palpable::vision {
namespace {

bool says_something(const ReadLine& read) { return !read.text.empty() || !read.others.empty(); }

bool is_level(const TextLine& line, const StackedLetteringOptions& options) {
  const MapPoint a = line.centre.front(), b = line.centre.back();
  return std::abs(b.y - a.y) <=
         std::tan(options.most_slope_deg * std::numbers::pi / 180.0) * std::abs(b.x - a.x);
}

MapPoint middle_of(const TextLine& line) {
  const MapPoint a = line.centre.front(), b = line.centre.back();
  return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
}

double colour_difference(Rgb8 a, Rgb8 b) {
  return std::hypot(static_cast<double>(a.r) - b.r, static_cast<double>(a.g) - b.g,
                    static_cast<double>(a.b) - b.b);
}

/// Whether two level lines stand one above the other.
bool are_stacked(const TextLine& a, const TextLine& b, const StackedLetteringOptions& options) {
  const MapPoint p = middle_of(a), q = middle_of(b);
  const double higher = std::max(a.height_px, b.height_px), lower = std::min(a.height_px, b.height_px);
  const double across = std::abs(p.y - q.y);
  return across >= options.least_distance * lower && across <= options.most_distance * higher &&
         std::abs(p.x - q.x) <= options.most_aside * 0.5 * (higher + lower) &&
         higher <= options.most_height_ratio * lower &&
         colour_difference(a.colour, b.colour) <= options.most_colour_difference;
}

}  // namespace

std::vector<Parameter> parameters_of(StackedLetteringOptions& o) {
  return {{"most_slope_deg", &o.most_slope_deg, {0, 45}, "degrees", "slope of a level line"},
          {"most_distance", &o.most_distance, {0, 10}, "heights", "distance of the next line"},
          {"most_aside", &o.most_aside, {0, 10}, "heights", "distance of their middles along the lines"},
          {"least_distance", &o.least_distance, {0, 5}, "heights", "nearer lines are the same lettering"},
          {"most_height_ratio", &o.most_height_ratio, {1, 10}, "", "of the two lines"},
          {"most_colour_difference", &o.most_colour_difference, {0, 442}, "levels", "between them"}};
}

std::vector<char> stacked_lettering(std::span<const TextLine> lines, std::span<const ReadLine> read,
                                    const StackedLetteringOptions& options) {
  std::vector<char> stacked(lines.size(), 0);
  std::vector<std::size_t> level;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (says_something(read[i]) && is_level(lines[i], options)) level.push_back(i);
  for (std::size_t a = 0; a < level.size(); ++a)
    for (std::size_t b = a + 1; b < level.size(); ++b)
      if (are_stacked(lines[level[a]], lines[level[b]], options)) stacked[level[a]] = stacked[level[b]] = 1;
  return stacked;
}

}  // namespace palpable::vision
