// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/note.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/streets/map_colours.hpp"
#include "palpable/vision/streets/street_colours.hpp"
#include "palpable/vision/streets/street_graph.hpp"
#include "palpable/vision/streets/street_names.hpp"
#include "palpable/vision/text/read_text.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <vector>

namespace palpable::vision {

struct StreetMapOptions {
  MapColourOptions colours;
  StreetColourOptions streets;
  TextLineOptions text;
  StreetGraphOptions graph;
  ReadTextOptions reading;
  StreetNameOptions names;
  /// Streets meet, and leave land between them: a map has at most this many dead ends for each junction, and
  /// at most this part of it has colours of streets.
  double dead_ends_per_junction = 1.6;
  double most_street_part = 0.6;
  /// A drawing has flat colours: at least this part of the neighbouring pixels inside its streets differ by
  /// at most one grey level. A lossy copy has not; it is taken for a map if its streets are this long in
  /// total, in the picture's shorter side, and at least this part of their length is of nearly constant
  /// width. It must have this many junctions and at most this many colours; a drawing, one of the two.
  double least_flat_part = 0.9;
  double lossy_length = 2.0;
  double lossy_ribbon_part = 0.55;
  int least_junctions = 5;
  /// Tables and boxes are drawn with dark lines, mostly along the picture's sides: a network is a drawing of
  /// these if its lines are darker than the land by this much, grey levels, and at least this part of their
  /// length is within this angle of a side, degrees.
  double ink_contrast = 150.0;
  double upright_part = 0.5;
  double upright_deg = 2.0;
  int most_colours = 26;
  /// Areas smaller than this are left out, pixels.
  double least_area_px = 40.0;
  /// Largest distance of a simplified line from the original one, pixels.
  double line_error_px = 0.4;
};

/// A map, and notes for the user about it.
struct FoundStreetMap {
  StreetMap map;
  std::vector<Note> notes;
};

/// Finds the streets, junctions, buildings, water and green areas of a street map by the flat colours that it
/// is drawn with, and reads its names; its style need not be known. Long work: reports progress, polls
/// cancel. Errors: invalid_input, without a place, for a picture without streets (a photograph, an empty
/// page); interrupted.
Result<FoundStreetMap> street_map_from_picture(const Image& picture, const StreetMapOptions& options,
                                               const Work& work);

}  // namespace palpable::vision
