// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/vision/streets/lines/centre_lines.hpp"
#include "palpable/vision/streets/names/streets_under_names.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <span>
#include <vector>

namespace palpable::vision {

struct LetteringAlongOptions {
  /// Ink of a name is at most this many of the lettering's heights beside the street's middle. 0.1 ... 2.
  double aside = 0.75;
  /// It differs from the lettering's colour by at most this, RGB levels. 0 ... 442.
  double most_colour_difference = 110.0;
  /// Largest gap between the words of a name, and least length of a name, in heights. 0 ... 5 and 0 ... 50.
  double word_gap = 1.0;
  double least_length = 2.5;
  /// Least and greatest height of a name, in that of the lettering. 0 ... 1 and 1 ... 5.
  double least_height = 0.6;
  double most_height = 1.45;
  /// A street is followed over a junction to the one that goes on within this angle, degrees. 0 ... 90.
  double most_turn_deg = 40.0;
  /// The line of a name is that of the street, as a moving mean over this many heights on both sides. 0 ...
  /// 10.
  double smoothing_heights = 1.5;
  /// A line of lettering that was read with this confidence, 0 ... 1, is not read again where it is as long.
  double sure = 0.85;
};
std::vector<Parameter> parameters_of(LetteringAlongOptions& options);

/// Lines of lettering that lie along the streets of a network: ink with the colour of the names, near to the
/// middle of a street, that has the height of the names. It finds names that bend with their street and names
/// that touch borders, which find_text_lines() does not. Any thread.
std::vector<TextLine> lettering_along(const Raster<Rgb8>& picture, const CentreLines& graph,
                                      const StreetLettering& lettering, const TextLineOptions& ink,
                                      const LetteringAlongOptions& options = {});

/// Both, without those of `along` that a line of `followed` covers in their whole length. Any thread.
std::vector<TextLine> different_lines(std::vector<TextLine> followed, std::vector<TextLine> along);

/// Of lines of lettering that cover each other, the one that more was read of stays: the letters times the
/// weight of the readings decide. Two names beside each other stay instead of a line that
/// holds both, and a name with its word of streets ("Rue") instead of one without. Any
/// thread.
void keep_best_readings(std::vector<TextLine>& lines, std::vector<ReadLine>& read);

/// Those of `along` that are not covered by a line that was read with at least `sure`. Any thread.
std::vector<TextLine> unread_lettering(std::vector<TextLine> along, std::span<const TextLine> lines,
                                       std::span<const ReadLine> read, double sure);

}  // namespace palpable::vision
