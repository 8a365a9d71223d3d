// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/vision/streets/lines/centre_lines.hpp"
#include "palpable/vision/text/read_text.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <optional>
#include <span>
#include <vector>

namespace palpable::vision {

struct StreetsUnderNamesOptions {
  /// A name lies on a street if at least this part of it is nearer to a centre line than this many of its
  /// heights. 0 ... 1 and 0 ... 5.
  double least_part_on_street = 0.6;
  double aside = 0.75;
  /// Names of streets are those that are read with at least this confidence, 0 ... 1. The map letters its
  /// streets alike if at least this many such names lie on streets. 1 ... 100.
  double least_confidence = 0.8;
  int fewest_names = 3;
  /// A street is added under a name that is read with at least this confidence. 0 ... 1.
  double least_name_confidence = 0.7;
  /// Lettering is like theirs if its mean colour differs by at most this, RGB levels, 0 ... 442, and its
  /// height by at most this factor, 1 ... 10.
  double most_colour_difference = 60.0;
  double most_height_ratio = 1.5;
  /// Of words of streets the colour may differ by this, RGB levels, 0 ... 442: the grounds around thin
  /// letters mix with it.
  double most_name_colour_difference = 90.0;
  /// A street under a name goes on to a street that is at most this many heights before its end, 0 ... 20, in
  /// a direction that differs by at most this much, degrees, 0 ... 90.
  double reach_heights = 2.5;
  double reach_angle_deg = 50.0;
};
std::vector<Parameter> parameters_of(StreetsUnderNamesOptions& options);

/// How a map letters the names of its streets.
struct StreetLettering {
  double height_px = 0.0;
  Rgb8 colour;
};

/// Measured on the names that were read on streets; nullopt if there are too few. `read` belongs to `lines`,
/// one for one. Any thread.
std::optional<StreetLettering> street_lettering(const CentreLines& graph, std::span<const TextLine> lines,
                                                std::span<const ReadLine> read,
                                                const StreetsUnderNamesOptions& options = {});

/// Whether a line has about the colour and the height of the streets' names. Any thread.
bool is_lettered_like(const TextLine& line, const StreetLettering& names,
                      const StreetsUnderNamesOptions& options = {});

/// Where lettering like that of streets says the name of a street ("Mill Lane") and lies on none, the street
/// is hidden by its name, or not drawn as streets are: a line is added along the name and to the streets at
/// its ends. Returns the number of lines. Any thread.
int add_streets_under(CentreLines& graph, std::span<const TextLine> lines, std::span<const ReadLine> read,
                      const StreetsUnderNamesOptions& options = {});

}  // namespace palpable::vision
