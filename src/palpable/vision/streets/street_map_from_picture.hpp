// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/note.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/streets/colours/map_colours.hpp"
#include "palpable/vision/streets/graph/street_graph.hpp"
#include "palpable/vision/streets/lines/dashed_lines.hpp"
#include "palpable/vision/streets/lines/street_colours.hpp"
#include "palpable/vision/streets/names/map_words.hpp"
#include "palpable/vision/streets/names/name_pieces.hpp"
#include "palpable/vision/streets/names/street_lettering.hpp"
#include "palpable/vision/streets/names/street_names.hpp"
#include "palpable/vision/streets/names/streets_under_names.hpp"
#include "palpable/vision/text/followed_lines.hpp"
#include "palpable/vision/text/line_extension.hpp"
#include "palpable/vision/text/read_text.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <vector>

namespace palpable::vision {

/// What tells a map from other pictures.
struct MapRecognitionOptions {
  /// Streets meet, and leave land between them: a map has at most this many dead ends for each junction, 0
  /// ... 100, and at most this part of it has colours of streets, 0 ... 1. An end this near to the picture's
  /// border is none, pixels, 0 ... 50.
  double dead_ends_per_junction = 1.6;
  double most_street_part = 0.6;
  double border_px = 4.0;
  /// A single street without junctions is the edge of the picture if half of it is at most this many of its
  /// radii, and a pixel, away from a side. 0 ... 10.
  double edge_radii = 1.5;
  /// A drawing has flat colours: at least this part of the neighbouring pixels inside its streets differ by
  /// at most one grey level. A lossy copy has not; it is taken for a map if its streets are this long in
  /// total, in the picture's shorter side, and at least this part of their length is of nearly constant
  /// width. It must have this many junctions and at most this many colours; a drawing, one of the two. 0 ...
  /// 1, 0 ... 100, 0 ... 1, 0 ... 1000, 2 ... 64.
  double least_flat_part = 0.9;
  double lossy_length = 2.0;
  double lossy_ribbon_part = 0.55;
  int least_junctions = 5;
  int most_colours = 26;
  /// Tables and boxes are drawn with dark lines, mostly along the picture's sides: a network is a drawing of
  /// these if its lines are darker than the land by this much, grey levels, 0 ... 255, and at least this part
  /// of their length, 0 ... 1, is within this angle of a side, degrees, 0 ... 45.
  double ink_contrast = 150.0;
  double upright_part = 0.5;
  double upright_deg = 2.0;
  /// Largest distance of the straight pieces, whose angle that is, from the lines, pixels. 0.1 ... 20.
  double straight_error_px = 1.0;
};
std::vector<Parameter> parameters_of(MapRecognitionOptions& options);

/// What is kept of outlines and lines.
struct MapOutlineOptions {
  /// Areas smaller than this are left out, pixels. 0 ... 1 000 000.
  double least_area_px = 40.0;
  /// Largest distance of a simplified outline of an area from the original one, pixels. 0 ... 20.
  double area_error_px = 1.0;
  /// A street's line is the moving mean of points within this many of its radii, 0 ... 5, but at least this
  /// many points, 0 ... 50.
  double smoothing_radii = 0.5;
  int least_smoothing_points = 2;
  /// Largest distance of a simplified line from that, pixels. 0 ... 20.
  double line_error_px = 0.4;
};
std::vector<Parameter> parameters_of(MapOutlineOptions& options);

/// How a map's picture becomes its streets, areas and names. Defaults were chosen on drawn maps of eight
/// styles (docs/maps.md), and are the same for every picture.
struct StreetMapOptions {
  MapColourOptions colours;
  /// On darker land than this, lettering is light, grey levels. 0 ... 255.
  double dark_land = 110.0;
  StreetColourOptions streets;
  TextLineOptions text;
  StreetGraphOptions graph;
  DashedLineOptions dashes;
  MapRecognitionOptions recognition;
  MapOutlineOptions outlines;
  ReadTextOptions reading;
  MapWordsOptions words;
  NamePiecesOptions pieces;
  StreetsUnderNamesOptions under_names;
  LetteringAlongOptions along_streets;
  LineExtensionOptions extension;
  FollowedLinesOptions followed;
  StreetNameOptions names;
};
/// Every parameter with its range, except languages and gazetteer.
std::vector<Parameter> parameters_of(StreetMapOptions& options);

/// Errors: usage, for a parameter out of its range, and for a smallest letter that is larger than the
/// largest.
Result<void> check(const StreetMapOptions& options);

/// A map, and notes for the user about it.
struct FoundStreetMap {
  StreetMap map;
  std::vector<Note> notes;
};

/// Finds the streets, junctions, buildings, water and green areas of a street map by the flat colours that it
/// is drawn with, and reads its names; its style need not be known. Long work: reports progress, polls
/// cancel. Errors: as check(); invalid_input, without a place, for a picture without streets (a photograph,
/// an empty page); interrupted.
Result<FoundStreetMap> street_map_from_picture(const Image& picture, const StreetMapOptions& options,
                                               const Work& work);

}  // namespace palpable::vision
