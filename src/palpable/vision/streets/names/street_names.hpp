// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/vision/streets/names/stacked_lettering.hpp"
#include "palpable/vision/streets/names/streets_under_names.hpp"
#include "palpable/vision/text/read_text.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::vision {

struct StreetNameOptions {
  /// A name lies on a street if at least this part of it, 0 ... 1, is nearer to the street's centre line than
  /// `aside` of its height, 0 ... 5, and its direction there differs by at most `aside_deg`, degrees, 0
  /// ... 90. Every such point of it is looked at, 1 ... 20.
  double least_part_on_street = 0.6;
  double aside = 0.75;
  double aside_deg = 36.87;
  int step_points = 3;
  /// Of several pieces of streets along a name, those that have fewer of its points than this part of the
  /// most belong to a street that crosses. 0 ... 1.
  double crossing_part = 1.0 / 3.0;
  /// A street with two names, one after the other, is divided between them: names that differ, of similarity
  /// below the first, 0 ... 1, each with at least the second part of its points there, 0 ... 1.
  double same_name = 0.7;
  double divided_part = 0.7;
  /// A name goes on over a junction to the unnamed street that continues in the same direction within this
  /// angle, degrees, 0 ... 180, and whose width differs by at most this part, 0 ... 1.
  double most_turn_deg = 30.0;
  double most_width_change = 0.35;
  /// The direction of a street at its end is that of this many widths of it, 0 ... 20, but at least this,
  /// pixels, 1 ... 100.
  double end_widths = 1.5;
  double least_end_px = 8.0;
  /// Without a gazetteer, names that are read with less confidence are labels of places. 0 ... 1.
  double least_confidence = 0.7;
  /// Without a gazetteer, lettering that ends nearer to the picture's border than this part of its height may
  /// be cut off, and is a label, 0 ... 5, unless its words are those of a street that is whole at that end:
  /// "Street" last, "Rue" first, or a capital letter before a word of streets.
  double border_heights = 0.5;
  /// Without a gazetteer, stacked lettering is a label.
  StackedLetteringOptions stacked;
  /// Names of the streets of the place, UTF-8; what is read becomes the most similar of them. Empty: none.
  std::vector<std::string> gazetteer;
  /// Least similarity of a name with that of the gazetteer, 0 ... 1: one minus their edit distance
  /// (core/text/edit_distance.hpp) as a part of the longer one's letters.
  double least_similarity = 0.7;
};
/// All but the gazetteer.
std::vector<Parameter> parameters_of(StreetNameOptions& options);

/// Whether words can be a whole name of a street: they begin with a capital or a digit, and have no marks but
/// those of names. Fragments of names seldom are so. UTF-8.
bool is_whole_name(std::string_view words);

/// Each line says the name of the gazetteer that its readings, also those that do not agree, are most similar
/// to, where that is at least `least`. Without a gazetteer nothing changes.
void spell_by_gazetteer(std::span<ReadLine> read, std::span<const std::string> gazetteer, double least);

/// Adds the map's lettering (`read` belongs to `lines`, one for one): a name that lies along a street becomes
/// the name of that street and of its straight continuation; other words become labels of places. Without a
/// gazetteer, words without one of streets ("Library") that are not lettered like the streets' names, where
/// `lettering` is given, are labels, too.
void add_names(StreetMap& map, std::span<const TextLine> lines, std::span<const ReadLine> read,
               const StreetNameOptions& options = {},
               const std::optional<StreetLettering>& lettering = std::nullopt);

}  // namespace palpable::vision
