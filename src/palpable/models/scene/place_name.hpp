// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/place.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace palpable::models {

/// Most names of a scene, and bytes of UTF-8 of a name and of its sentence.
inline constexpr std::size_t kMaxPlaceNames = 500;
inline constexpr std::size_t kMaxPlaceNameBytes = 400;
inline constexpr std::size_t kMaxPlaceSentenceBytes = 2000;
/// Most points of the line that a name covers.
inline constexpr std::size_t kMaxPlaceLine = 256;

/// What a person calls a point of a scene, or something that the program found there.
struct PlaceName {
  /// What it covers: what lies around `at`; what lies on its line; what its line encloses; every place that
  /// has the label of `at`.
  enum class Extent : std::uint8_t { point, line, area, label };
  /// One line, as plain_name() leaves it; not empty.
  std::string name;
  /// What else is said of it, as plain_name() leaves it; may be empty.
  std::string sentence = {};
  Place at = {};
  Extent extent = Extent::point;
  /// Of a line or an area (whose last point is not the first one): at least two points; else empty.
  std::vector<Place> line = {};
  bool operator==(const PlaceName&) const = default;
};

/// Whether lengths and numbers are within their limits and the words are plain: the check for input from
/// files.
bool is_valid(const PlaceName& name);

/// Names as they are edited: a value for each step, so that each can be undone.
using PlaceNames = std::vector<PlaceName>;

/// The names with one more, or with one instead of that at `replaced`, which must be one of them. Characters
/// that control a display or the direction of writing are removed. Errors: usage for a name that is empty, a
/// name or sentence that is too long, too many names, and a name that the same place has already.
Result<PlaceNames> with_name(PlaceNames names, PlaceName name, std::optional<std::size_t> replaced = {});

/// The nearest place of a line, and how far away it is.
struct OnLine {
  double distance_m = 0.0;
  Place at;
};
/// Of a line of at least one point.
OnLine nearest_on_line(const std::vector<Place>& line, Place from);
/// Of what a closed line encloses: distance 0 inside.
OnLine nearest_in_area(const std::vector<Place>& line, Place from);
/// How much a closed line encloses, m2.
double area_m2(const std::vector<Place>& line);

}  // namespace palpable::models
