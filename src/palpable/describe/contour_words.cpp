// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/contour_words.hpp"

#include "palpable/describe/contour_lines.hpp"
#include "palpable/describe/language.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/place_words.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

/// "closed", "2 of them closed" …
std::string closed_words(const std::vector<ContourLine>& lines) {
  const auto closed = static_cast<std::size_t>(
      std::count_if(lines.begin(), lines.end(), [](const ContourLine& line) { return line.closed; }));
  if (lines.size() == 1) return closed == 1 ? tr("closed") : tr("open");
  if (closed == 0) return tr("none of them closed");
  return closed == lines.size() ? tr("all closed") : phrase("{} of them closed", closed);
}

/// ", meeting in 4 places"; ", meeting at the centre". Empty where none meet.
std::string junction_words(const ContourDrawing& drawing, const models::BoundaryMap& map) {
  if (drawing.junctions.empty()) return {};
  const bool itself = drawing.lines.size() == 1;
  constexpr std::size_t kMostPlaces = 3;
  std::vector<std::string> places;
  for (const Place& place : drawing.junctions)
    places.push_back(region_words(place, map.size_x_m(), map.size_y_m()));
  if (drawing.junctions.size() == 1)
    return ", " + phrase(itself ? "meeting itself in 1 place: {}" : "meeting in 1 place: {}", places.front());
  if (drawing.junctions.size() > kMostPlaces)
    return ", " +
           phrase(itself ? "meeting itself in {} places" : "meeting in {} places", drawing.junctions.size());
  return ", " + phrase(itself ? "meeting itself in {} places: {}" : "meeting in {} places: {}",
                       drawing.junctions.size(), counted_places(places));
}

/// Empty if the number of areas follows from the closed lines.
std::string area_words(const ContourDrawing& drawing) {
  const auto closed = static_cast<std::size_t>(std::count_if(
      drawing.lines.begin(), drawing.lines.end(), [](const ContourLine& line) { return line.closed; }));
  if (drawing.enclosed_areas == closed) return {};
  return " " + phrase("{} enclosed by lines.",
                      capitalised(counted(drawing.enclosed_areas, "area is", "areas are")));
}

std::string extent_words(const ContourLine& line) {
  constexpr double kStraight = 0.97;
  const double dx = line.last.x_m - line.first.x_m, dy = line.last.y_m - line.first.y_m;
  if (!line.closed && std::hypot(dx, dy) > kStraight * line.length_m)
    return phrase("straight, {}", line_words(std::atan2(dy, dx)));
  return phrase("{} wide and {} high", spoken_length(line.most.x_m - line.least.x_m),
                spoken_length(line.most.y_m - line.least.y_m));
}

std::string line_part(const ContourLine& line, const models::BoundaryMap& map) {
  return phrase("{}, {} long, {}, {}", tr(line.closed ? "closed" : "open"), spoken_length(line.length_m),
                region_words(line.middle(), map.size_x_m(), map.size_y_m()), extent_words(line));
}

}  // namespace

std::vector<std::string> contour_parts(const models::BoundaryMap& map, const std::string& heading,
                                       Place probe) {
  const ContourDrawing drawing = find_contour_lines(map);
  const auto& lines = drawing.lines;
  const std::string size = capitalised(spoken_lengths(map.size_x_m(), "by", map.size_y_m()));
  if (lines.empty()) return {phrase("{} {}. No lines.", heading, size)};
  const bool one = lines.size() == 1;
  const std::string brief = fmt::format(
      "{} {}. {}, {}{}.{} {}: {}.", heading, size, capitalised(counted(lines.size(), "line", "lines")),
      closed_words(lines), junction_words(drawing, map), area_words(drawing),
      tr(one ? "The line" : "The longest"), line_part(lines.front(), map));
  std::string more;
  if (const auto near = nearest_line(map, probe, std::max(map.size_x_m(), map.size_y_m())))
    more = phrase("From the probe to the nearest line: {}.", offset_words(near->dx_m, near->dy_m)) + " ";
  // Further lines are only counted: nobody would remember them.
  constexpr std::size_t kMostListed = 8;
  more += lines.size() > kMostListed ? phrase("The {} longest lines.", kMostListed)
                                     : tr(one ? "The line." : "The lines.");
  for (std::size_t k = 0; k < std::min(lines.size(), kMostListed); ++k)
    more += fmt::format(" {}: {}.", k + 1, line_part(lines[k], map));
  return {brief, more};
}

}  // namespace palpable::describe
