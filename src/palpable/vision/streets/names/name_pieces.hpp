// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/vision/text/read_text.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <string_view>
#include <vector>

namespace palpable::vision {

struct NamePiecesOptions {
  /// Largest gap between two pieces of a name, in the height of the larger one, 0 ... 10, and the largest
  /// turn between them, degrees, 0 ... 120: names bend with their streets.
  double most_gap = 1.5;
  double most_turn_deg = 80.0;
  /// The higher piece is at most this many times as high. 1 ... 10.
  double most_height_ratio = 1.6;
};
std::vector<Parameter> parameters_of(NamePiecesOptions& options);

/// Whether words cannot be a whole name of a street: they only begin one ("Rue", "Avenue de la", "Im") or
/// only end one ("Street", "1er", "II"), in English, French, German, Italian or Spanish. UTF-8.
bool is_piece_of_name(std::string_view words);

/// Divides lettering of two names one after the other, each of which ends with a word of streets that is
/// written as one with it ("Forellenweg Gerberweg"). Any thread.
void divide_names_in_row(std::vector<TextLine>& lines, std::vector<ReadLine>& read);

/// Joins words that only begin or end a name to the lettering that follows or precedes them, also around a
/// bend. A word that only begins a name may have letters of the next one behind it ("Rue je" before "Jean
/// Bouin"), which are left out. Any thread.
void join_name_pieces(std::vector<TextLine>& lines, std::vector<ReadLine>& read,
                      const NamePiecesOptions& options = {});

}  // namespace palpable::vision
