// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/street_map_from_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

std::optional<MapArea::Kind> area_kind(MapLayer layer) {
  if (layer == MapLayer::building) return MapArea::Kind::building;
  if (layer == MapLayer::water) return MapArea::Kind::water;
  if (layer == MapLayer::green) return MapArea::Kind::green;
  return std::nullopt;
}

/// The outlines of all areas of one colour.
void add_areas(const MapColours& colours, std::size_t k, MapArea::Kind kind, const MapOutlineOptions& options,
               std::vector<MapArea>& areas) {
  const Raster<std::uint8_t>& of_pixel = colours.of_pixel;
  const cv::Mat view(of_pixel.height(), of_pixel.width(), CV_8U, const_cast<std::uint8_t*>(of_pixel.data()));
  const cv::Mat mask = view == static_cast<double>(k);
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
  for (const auto& outline : outlines) {
    if (cv::contourArea(outline) < options.least_area_px) continue;
    std::vector<cv::Point> corners;
    cv::approxPolyDP(outline, corners, options.area_error_px, true);
    if (corners.size() < 3) continue;
    MapArea area{kind, {}};
    for (const cv::Point p : corners)
      area.outline.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
    areas.push_back(std::move(area));
  }
}

/// Part of the neighbouring pixels inside streets that differ by at most one grey level.
double flat_part(const Raster<Rgb8>& pixels, const MapColours& colours,
                 const std::vector<LayerOfColour>& layers) {
  std::size_t flat = 0;
  std::size_t all = 0;
  const auto is_street = [&](int x, int y) {
    return colours.seen(x, y) == MapColours::kArea &&
           layers[colours.of_pixel(x, y)].layer == MapLayer::street;
  };
  for (int y = 0; y < pixels.height(); ++y)
    for (int x = 1; x < pixels.width(); ++x) {
      if (!is_street(x, y) || !is_street(x - 1, y) || colours.of_pixel(x, y) != colours.of_pixel(x - 1, y))
        continue;
      const Rgb8 a = pixels(x, y);
      const Rgb8 b = pixels(x - 1, y);
      ++all;
      flat += std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) <= 1 ? 1 : 0;
    }
  return all == 0 ? 0.0 : static_cast<double>(flat) / static_cast<double>(all);
}

/// What tells a network of streets from stripes and from the outlines of things.
struct NetworkShape {
  double length_px = 0.0;
  /// Part of the length that is of nearly constant width.
  double ribbon_part = 0.0;
  int junctions = 0;
  /// Ends that are not at the picture's border, and those that are.
  int dead_ends = 0;
  int border_ends = 0;
  /// Part of the picture that has colours of streets.
  double street_part = 0.0;
};

NetworkShape shape_of(const MapColours& colours, const std::vector<LayerOfColour>& layers,
                      const CentreLines& graph, const StreetMapOptions& options) {
  NetworkShape shape;
  double ribbons = 0.0;
  for (const CentreLine& line : graph.lines) {
    const double length = length_px(line.points);
    shape.length_px += length;
    const bool is_ribbon = length > 2.0 * options.streets.least_length_widths * line.radius_px &&
                           line.radius_spread_px < options.streets.most_width_spread * line.radius_px;
    ribbons += is_ribbon ? length : 0.0;
  }
  shape.ribbon_part = ribbons / std::max(1.0, shape.length_px);
  const std::vector<int> degrees = degrees_of(graph);
  for (std::size_t n = 0; n < degrees.size(); ++n) {
    const MapPoint p = graph.nodes[n];
    shape.junctions += degrees[n] > 2 ? 1 : 0;
    if (degrees[n] != 1) continue;
    const bool at_border = distance_to_side(colours.frame, p) <= options.recognition.border_px;
    ++(at_border ? shape.border_ends : shape.dead_ends);
  }
  std::size_t streets = 0;
  for (const std::uint8_t c : colours.of_pixel.values())
    streets += c != MapColours::kNone && layers[c].layer == MapLayer::street ? 1 : 0;
  shape.street_part = static_cast<double>(streets) / static_cast<double>(colours.of_pixel.count());
  return shape;
}

double luma_of(Rgb8 c) { return 0.299 * c.r + 0.587 * c.g + 0.114 * c.b; }

/// The most frequent colour.
Rgb8 land_of(const MapColours& colours) {
  return std::max_element(colours.colours.begin(), colours.colours.end(),
                          [](const MapColour& a, const MapColour& b) { return a.pixels < b.pixels; })
      ->value;
}

/// Whether a network is a table, or boxes joined by lines.
bool is_line_drawing(const MapColours& colours, const std::vector<LayerOfColour>& layers,
                     const CentreLines& graph, const MapRecognitionOptions& options) {
  const double most_luma = luma_of(land_of(colours)) - options.ink_contrast;
  for (std::size_t k = 0; k < layers.size(); ++k)
    if (layers[k].layer == MapLayer::street && luma_of(colours.colours[k].value) > most_luma) return false;
  double all = 0.0;
  double upright = 0.0;
  const double least = std::cos(options.upright_deg * std::numbers::pi / 180.0);
  for (const CentreLine& line : graph.lines) {
    const std::vector<MapPoint> corners = simplified(line.points, options.straight_error_px);
    for (std::size_t i = 1; i < corners.size(); ++i) {
      const double dx = std::abs(corners[i].x - corners[i - 1].x);
      const double dy = std::abs(corners[i].y - corners[i - 1].y);
      const double length = std::hypot(dx, dy);
      all += length;
      upright += std::max(dx, dy) >= least * length ? length : 0.0;
    }
  }
  return upright >= options.upright_part * all;
}

/// Whether a line is the edge of the picture rather than a street: it runs along a side as near as it is
/// wide.
bool is_edge(const MapColours& colours, const CentreLine& line, const MapRecognitionOptions& options) {
  const auto near = std::count_if(line.points.begin(), line.points.end(), [&](MapPoint p) {
    return distance_to_side(colours.frame, p) <= options.edge_radii * line.radius_px + 1.0;
  });
  return 2 * static_cast<std::size_t>(near) > line.points.size();
}

/// Whether what was found is a network of streets in a drawing, not stripes or a photograph.
bool is_street_map(const MapColours& colours, const std::vector<LayerOfColour>& layers,
                   const CentreLines& graph, const StreetMapOptions& all) {
  if (graph.lines.empty()) return false;
  const MapRecognitionOptions& options = all.recognition;
  const NetworkShape shape = shape_of(colours, layers, graph, all);
  if (is_line_drawing(colours, layers, graph, options)) return false;
  const bool is_one_street =
      shape.junctions == 0 && shape.border_ends == 2 && !is_edge(colours, graph.lines.front(), options);
  if (shape.street_part > options.most_street_part || (shape.junctions < 1 && !is_one_street) ||
      shape.dead_ends > options.dead_ends_per_junction * shape.junctions)
    return false;
  const bool is_small = shape.junctions < options.least_junctions;
  const bool is_colourful = static_cast<int>(colours.colours.size()) > options.most_colours;
  if (is_small && is_colourful) return false;
  if (flat_part(colours.picture, colours, layers) >= options.least_flat_part) return true;
  return shape.length_px >=
             options.lossy_length * std::min(colours.of_pixel.width(), colours.of_pixel.height()) &&
         !is_small && !is_colourful && shape.ribbon_part >= options.lossy_ribbon_part;
}

/// Whether the land is dark: then lettering is light.
bool has_dark_land(const MapColours& colours, const StreetMapOptions& options) {
  return !colours.colours.empty() && luma_of(land_of(colours)) < options.dark_land;
}

/// A picture whose lettering is dark, as the reader expects it, with the colours of its areas.
struct Lettering {
  Raster<Rgb8> picture;
  std::vector<Rgb8> grounds;
};

/// Light lettering on dark land becomes dark. Only there, and in pictures without noise, are the areas'
/// colours given: streets are darker than the halos of their names there, and noise hides which pixels have a
/// colour.
Lettering dark_lettering_of(const Raster<Rgb8>& picture, const MapColours& colours,
                            const StreetMapOptions& options) {
  Lettering out{picture, {}};
  if (!has_dark_land(colours, options)) return out;
  const auto negative = [](Rgb8 c) {
    return Rgb8{static_cast<std::uint8_t>(255 - c.r), static_cast<std::uint8_t>(255 - c.g),
                static_cast<std::uint8_t>(255 - c.b)};
  };
  std::transform(picture.values().begin(), picture.values().end(), out.picture.values().begin(), negative);
  const bool is_clean =
      std::equal(picture.values().begin(), picture.values().end(), colours.picture.values().begin());
  if (is_clean)
    for (const MapColour& colour : colours.colours) out.grounds.push_back(negative(colour.value));
  return out;
}

/// The streets and junctions of a network.
void add_network(StreetMap& map, const CentreLines& graph, const MapOutlineOptions& options) {
  for (const CentreLine& line : graph.lines) {
    const int reach =
        std::max(options.least_smoothing_points, static_cast<int>(options.smoothing_radii * line.radius_px));
    map.streets.push_back({{},
                           2.0 * line.radius_px,
                           simplified(smoothed(line.points, reach), options.line_error_px),
                           true,
                           line.kind});
  }
  const std::vector<int> degrees = degrees_of(graph);
  for (std::size_t n = 0; n < degrees.size(); ++n)
    if (degrees[n] > 2) map.junctions.push_back({graph.nodes[n], degrees[n], false});
}

/// The tracks and paths that the map draws as dashed lines; dashes of water are streams in pipes.
CentreLines paths_of(const Raster<Rgb8>& dark_lines, const MapColours& colours,
                     const std::vector<LayerOfColour>& layers, const StreetMapOptions& options) {
  Raster<std::uint8_t> street(dark_lines.width(), dark_lines.height());
  for (int y = 0; y < street.height(); ++y)
    for (int x = 0; x < street.width(); ++x)
      street(x, y) =
          colours.seen(x, y) == MapColours::kArea && layers[colours.of_pixel(x, y)].layer == MapLayer::street
              ? 1
              : 0;
  std::vector<Rgb8> water;
  for (std::size_t k = 0; k < layers.size(); ++k)
    if (layers[k].layer == MapLayer::water) water.push_back(colours.colours[k].value);
  return dashed_lines(dark_lines, street, water, options.dashes);
}

/// Reads lines that were read and go on behind their ends once more, whole.
Result<void> read_extended(const Lettering& lettering, std::vector<TextLine>& text,
                           std::vector<ReadLine>& read, const StreetMapOptions& options, const Work& work) {
  std::vector<TextLine> said;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (!read[i].others.empty()) said.push_back(text[i]);
  const std::vector<TextLine> longer =
      extended_lines(lettering.picture, said, options.text.thickest_stroke_px, options.extension);
  auto more = read_text_lines(lettering.picture, longer, options.reading, work, lettering.grounds);
  if (!more) return more.error();
  spell_by_gazetteer(more->lines, options.names.gazetteer, options.names.least_similarity);
  for (std::size_t i = 0; i < longer.size(); ++i) {
    if (more->lines[i].text.empty()) continue;
    text.push_back(longer[i]);
    read.push_back(std::move(more->lines[i]));
  }
  if (options.names.gazetteer.empty()) correct_by_map_words(read, options.words);
  keep_best_readings(text, read);
  return {};
}

/// Reads lettering like that of the streets' names that was not found, or not whole, by its letters alone.
Result<void> read_street_lettering(const Lettering& lettering, const CentreLines& graph,
                                   std::vector<TextLine>& text, std::vector<ReadLine>& read,
                                   const StreetMapOptions& options, const Work& work) {
  const auto names = street_lettering(graph, text, read, options.under_names);
  if (!names) return {};
  const std::vector<TextLine> more_text = unread_lettering(
      different_lines(
          followed_lines(lettering.picture, names->height_px, names->colour, options.text, options.followed),
          lettering_along(lettering.picture, graph, *names, options.text, options.along_streets)),
      text, read, options.along_streets.sure);
  auto more = read_text_lines(lettering.picture, more_text, options.reading, work, lettering.grounds);
  if (!more) return more.error();
  spell_by_gazetteer(more->lines, options.names.gazetteer, options.names.least_similarity);
  for (std::size_t i = 0; i < more_text.size(); ++i) {
    if (more->lines[i].text.empty()) continue;
    text.push_back(more_text[i]);
    read.push_back(more->lines[i]);
  }
  if (options.names.gazetteer.empty()) correct_by_map_words(read, options.words);
  keep_best_readings(text, read);
  return {};
}

}  // namespace

Result<FoundStreetMap> street_map_from_picture(const Image& picture, const StreetMapOptions& options,
                                               const Work& work) {
  if (auto valid = check(options); !valid) return valid.error();
  work.report(0.0, "finding the map's colours");
  const Raster<Rgb8> pixels = rgb8(picture);
  const MapColours colours = find_map_colours(pixels, options.colours);
  if (work.cancelled()) return Work::interrupted();
  work.report(0.1, "finding streets");
  const std::vector<LayerOfColour> layers = layers_of(colours, options.streets);
  if (work.cancelled()) return Work::interrupted();
  work.report(0.3, "joining streets");
  const Lettering lettering = dark_lettering_of(pixels, colours, options);
  std::vector<TextLine> text = find_text_lines(lettering.picture, options.text);
  CentreLines graph = join_streets(colours, layers, text, options.graph);
  if (!is_street_map(colours, layers, graph, options))
    return invalid_input(
        "no streets were found in this picture: it is not a street map drawn in flat colours");
  graph = join_paths(std::move(graph), paths_of(lettering.picture, colours, layers, options), colours, layers,
                     text, options.graph);
  FoundStreetMap out;
  StreetMap& map = out.map;
  map.width_px = picture.width;
  map.height_px = picture.height;
  for (std::size_t k = 0; k < layers.size(); ++k)
    if (const auto kind = area_kind(layers[k].layer))
      add_areas(colours, k, *kind, options.outlines, map.areas);
  work.report(0.4, "reading names");
  auto reading = read_text_lines(lettering.picture, text, options.reading, work, lettering.grounds);
  if (!reading) return reading.error();
  spell_by_gazetteer(reading->lines, options.names.gazetteer, options.names.least_similarity);
  if (auto more = read_street_lettering(lettering, graph, text, reading->lines, options, work); !more)
    return more.error();
  if (auto more = read_extended(lettering, text, reading->lines, options, work); !more) return more.error();
  divide_names_in_row(text, reading->lines);
  join_name_pieces(text, reading->lines, options.pieces);
  const auto names = street_lettering(graph, text, reading->lines, options.under_names);
  add_streets_under(graph, text, reading->lines, options.under_names);
  add_network(map, graph, options.outlines);
  add_names(map, text, reading->lines, options.names, names);
  out.notes = std::move(reading->notes);
  return out;
}

}  // namespace palpable::vision
