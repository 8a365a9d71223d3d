// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/result.hpp"

#include <string>
#include <vector>

namespace palpable::measure {

/// A way of the true map, in pixels of the picture; parts outside the picture do not count.
struct TrueStreet {
  /// OpenStreetMap's value of the key `highway`, as "residential".
  std::string kind;
  /// UTF-8; empty if it has none.
  std::string name;
  /// 0 if it is not known.
  double width_px = 0.0;
  std::vector<std::vector<MapPoint>> lines;
};

struct TrueStreetMap {
  int width_px = 0;
  int height_px = 0;
  std::vector<TrueStreet> streets;
  /// The names that the picture shows whole. Empty if that is not known.
  std::vector<std::string> drawn_names;
};

struct StreetMapScoreOptions {
  /// A point of a true centre line counts as found within this distance of a found one, pixels.
  double found_px = 3.0;
  /// The same, for the stricter figure.
  double close_px = 2.0;
  /// A found point counts as true within this distance of any true way, pixels.
  double true_px = 4.0;
  /// A junction counts as found within this distance, pixels.
  double junction_px = 5.0;
  /// If it is not known which names the picture shows: those of streets of which more than this is inside it,
  /// pixels.
  double named_px = 90.0;
};

/// Parts are 0 ... 1. Wanted are the streets for cars and for pedestrians: not service ways, paths and steps,
/// which are true where they are found.
struct StreetMapScore {
  /// Length of the wanted centre lines, pixels; the part that was found, and that was found closely.
  double length_px = 0.0;
  double found = 0.0;
  double found_closely = 0.0;
  /// Part of the found centre lines that is on a true way.
  double true_part = 0.0;
  /// Street area that both have, as a part of what one of them has. A true street without a width has that of
  /// the found street beside it; ways that are not wanted count for neither.
  double area_iou = 0.0;
  /// Junctions of wanted streets, how many were found, how many of these with the right degree, and how many
  /// found ones are none of any true ways.
  int junctions = 0;
  int junctions_found = 0;
  int junctions_right_degree = 0;
  int junctions_false = 0;
  /// Names as vision::compared_form: those of the picture, how many of them some street has, how many names
  /// no true street has.
  int names = 0;
  int names_right = 0;
  int names_false = 0;

  /// F measure of the junctions; 0 if there are none.
  double junction_f() const;
};

/// Compares a map that was found in a picture with the true one. Errors: invalid_input for sizes that differ
/// and for a truth without wanted streets.
Result<StreetMapScore> score_street_map(const StreetMap& found, const TrueStreetMap& truth,
                                        const StreetMapScoreOptions& options = {});

}  // namespace palpable::measure
